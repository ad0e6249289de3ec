// FCPW as a child process of the race: it reads a mesh, then lists of points, and answers each list
// with the time that it took.
//
// From the standard input, once: the mesh. To the standard output, once the scene is built:
//   u64 0 for bytes, which FCPW does not tell, f64 seconds of the build
// Then any number of times, until the input ends:
//   u32 0, u32 count, f32 [count][3] points
// Answered by:
//   f64 seconds, f32 [count][3] closest points

#include "child.h"

#include <fcpw/fcpw.h>

int main() {
    Mesh mesh = read_mesh();
    std::vector<fcpw::Vector<3>> positions;
    for (Point p : mesh.vertices) positions.emplace_back(p.x, p.y, p.z);
    std::vector<fcpw::Vector3i> triangles;
    for (const Triangle &t : mesh.triangles)
        triangles.emplace_back(t.corners[0], t.corners[1], t.corners[2]);
    double begun = processor_seconds();
    fcpw::Scene<3> scene;
    scene.setObjectCount(1);
    scene.setObjectVertices(positions, 0);
    scene.setObjectTriangles(triangles, 0);
    scene.build(fcpw::AggregateType::Bvh_SurfaceArea, true);
    double seconds = processor_seconds() - begun;
    uint64_t bytes = 0;
    write(&bytes, 1);
    write(&seconds, 1);
    std::fflush(stdout);
    uint32_t question = 0, count = 0;
    while (read(question) && read(count)) {
        if (question != 0) return 4;
        answer<Point, Point>(count, [&](Point at) -> Point {
            fcpw::Interaction<3> found;
            scene.findClosestPoint(fcpw::Vector<3>(at.x, at.y, at.z), found);
            return {found.p[0], found.p[1], found.p[2]};
        });
    }
}
