// CGAL's Hausdorff distance with a bounded error, as a child process of the race.
//
// From the standard input, once: two meshes. To the standard output, once CGAL has them: u64 1.
// Then any number of times, until the input ends:
//   u32 question, u32 1, f64 error bound
// Answered by:
//   f64 seconds, f64 distance, off by at most the error bound
// The seconds include CGAL's trees, not its meshes. A mesh that is no manifold ends the child.

#include "child.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using One = CGAL::Sequential_tag;
namespace processing = CGAL::Polygon_mesh_processing;

enum Question : uint32_t { FORWARD = 0, BACKWARD = 1, BOTH = 2 };

Surface surface_of(const Mesh &mesh) {
    Surface surface;
    std::vector<Surface::Vertex_index> vertices;
    for (Point p : mesh.vertices) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
    for (Triangle t : mesh.triangles) {
        auto [a, b, c] = t.corners;
        if (surface.add_face(vertices[a], vertices[b], vertices[c]) == Surface::null_face()) {
            std::exit(5);
        }
    }
    return surface;
}

} // namespace

int main() {
    Surface first = surface_of(read_mesh()), second = surface_of(read_mesh());
    uint64_t ready = 1;
    write(&ready, 1);
    std::fflush(stdout);
    uint32_t question = 0, count = 0;
    while (read(question) && read(count)) {
        answer<double, double>(count, [&](double error) {
            switch (question) {
            case FORWARD:
                return processing::bounded_error_Hausdorff_distance<One>(first, second, error);
            case BACKWARD:
                return processing::bounded_error_Hausdorff_distance<One>(second, first, error);
            default:
                return processing::bounded_error_symmetric_Hausdorff_distance<One>(
                    first, second, error);
            }
        });
    }
}
