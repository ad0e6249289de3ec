// FCL as a child process of the race: a mesh, and a moved copy of it.
//
// From the standard input, once: the mesh. Then any number of times, until the input ends:
//   u32 question, u32 count, f64 [count][3][4] poses of the copy: rows of the rotation and shift
// Answered by:
//   f64 seconds, f64 [count] distances, or 1 where the surfaces meet and 0 where not

#include "child.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace {

// Boxes for overlap and swept rectangles for distances: FCL's own choice for both questions.
using Model = fcl::BVHModel<fcl::OBBRSSd>;

enum Question : uint32_t { DISTANCE = 0, MEETS = 1 };

struct Pose {
    double rows[3][4];

    fcl::Transform3d transform() const {
        fcl::Transform3d pose = fcl::Transform3d::Identity();
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) pose.linear()(i, k) = rows[i][k];
            pose.translation()[i] = rows[i][3];
        }
        return pose;
    }
};

void build(Model &model, const Mesh &mesh) {
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (Point p : mesh.vertices) vertices.emplace_back(p.x, p.y, p.z);
    for (Triangle t : mesh.triangles) {
        auto [a, b, c] = t.corners;
        triangles.emplace_back(a, b, c);
    }
    model.beginModel(triangles.size(), vertices.size());
    model.addSubModel(vertices, triangles);
    model.endModel();
}

double distance(const Model &model, const Pose &pose) {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::Transform3d here = fcl::Transform3d::Identity(), there = pose.transform();
    fcl::distance(&model, here, &model, there, request, result);
    return result.min_distance;
}

double meets(const Model &model, const Pose &pose) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::Transform3d here = fcl::Transform3d::Identity(), there = pose.transform();
    return fcl::collide(&model, here, &model, there, request, result) > 0;
}

} // namespace

int main() {
    Mesh mesh = read_mesh();
    Model model;
    build(model, mesh);
    uint32_t question = 0, count = 0;
    while (read(question) && read(count)) {
        if (question == DISTANCE)
            answer<Pose, double>(count, [&](const Pose &pose) { return distance(model, pose); });
        else
            answer<Pose, double>(count, [&](const Pose &pose) { return meets(model, pose); });
    }
}
