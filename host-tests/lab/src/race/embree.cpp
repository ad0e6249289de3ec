// Embree as a child process of the race: it reads a mesh, then lists of queries, and answers each
// list with the time that it took.
//
// From the standard input, once: the mesh. To the standard output, once the scene is built:
//   u64 bytes that Embree holds, f64 seconds of the build
// Then any number of times, until the input ends:
//   u32 question, u32 count, f32 [count][3] points or [count][2][3] segments
// Answered by:
//   f64 seconds, f32 [count][3] closest points or f32 [count] parameters, -1 for a miss and 0 for
//   any hit

#include "child.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>

namespace {

Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator*(float s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
float dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Segment {
    Point from, to;
};

enum Question : uint32_t { CLOSEST_POINT = 0, FIRST_HIT = 1, ANY_HIT = 2 };

std::atomic<int64_t> bytes_held{0};

bool count_bytes(void *, ssize_t bytes, bool) {
    bytes_held += bytes;
    return true;
}

// Ericson, "Real-time collision detection", 2005, section 5.1.5.
Point closest_on(Point p, Point a, Point b, Point c) {
    Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    float d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    float d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    float d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    float va = d3 * d6 - d5 * d4;
    float along = d4 - d3, back = d5 - d6;
    if (va <= 0 && along >= 0 && back >= 0) return b + along / (along + back) * (c - b);
    float scale = 1 / (va + vb + vc);
    return a + vb * scale * ab + vc * scale * ac;
}

struct Nearest {
    const Mesh &mesh;
    Point point;
};

// Narrows the query's ball to the nearest triangle so far.
bool look_at_triangle(RTCPointQueryFunctionArguments *at) {
    Nearest &nearest = *static_cast<Nearest *>(at->userPtr);
    const uint32_t *corners = nearest.mesh.triangles[at->primID].corners;
    const std::vector<Point> &vertices = nearest.mesh.vertices;
    Point asked = {at->query->x, at->query->y, at->query->z};
    Point point =
        closest_on(asked, vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]);
    Point away = point - asked;
    float distance = std::sqrt(dot(away, away));
    if (distance >= at->query->radius) return false;
    at->query->radius = distance;
    nearest.point = point;
    return true;
}

Point closest_point(RTCScene scene, const Mesh &mesh, Point at) {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query = {at.x, at.y, at.z, 0, std::numeric_limits<float>::infinity()};
    Nearest nearest = {mesh, at};
    rtcPointQuery(scene, &query, &context, look_at_triangle, &nearest);
    return nearest.point;
}

RTCRay ray_along(Segment segment) {
    Point d = segment.to - segment.from, o = segment.from;
    RTCRay ray = {};
    ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
    ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
    ray.tfar = 1;
    ray.mask = ~0u;
    return ray;
}

float first_hit(RTCScene scene, Segment segment) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit = {ray_along(segment), {}};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : hit.ray.tfar;
}

float any_hit(RTCScene scene, Segment segment) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_along(segment);
    rtcOccluded1(scene, &context, &ray);
    // Embree marks a ray that hits by an infinite negative end.
    return ray.tfar < 0 ? 0 : -1;
}

RTCScene build(RTCDevice device, const Mesh &mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto fill = [&](RTCBufferType type, RTCFormat format, const auto &items) {
        size_t stride = sizeof items[0];
        void *buffer =
            rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, items.size());
        std::copy(items.begin(), items.end(),
                  static_cast<typename std::decay_t<decltype(items)>::value_type *>(buffer));
    };
    fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
    fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    // No hit is lost between two triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

} // namespace

int main() {
    Mesh mesh = read_mesh();
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, nullptr);
    double begun = processor_seconds();
    RTCScene scene = build(device, mesh);
    double seconds = processor_seconds() - begun;
    int64_t bytes = bytes_held;
    write(&bytes, 1);
    write(&seconds, 1);
    std::fflush(stdout);
    uint32_t question = 0, count = 0;
    while (read(question) && read(count)) {
        switch (question) {
        case CLOSEST_POINT:
            answer<Point, Point>(count, [&](Point at) { return closest_point(scene, mesh, at); });
            break;
        case FIRST_HIT:
            answer<Segment, float>(count, [&](Segment s) { return first_hit(scene, s); });
            break;
        case ANY_HIT:
            answer<Segment, float>(count, [&](Segment s) { return any_hit(scene, s); });
            break;
        default:
            return 4;
        }
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
