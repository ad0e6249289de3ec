/* A robot's arm stops before it comes near a third link that stands in its way. The same program in
 * Rust: core/examples/guard.
 *
 * A tight hull of 40 faces stands for each link of 284 triangles. It encloses the link: where hulls
 * are apart, links are. Each pose is proved clear before the arm goes there. link.h and link.c are
 * by `meshsweep build link.obj -o link.msw --for tight --tight 40 --emit c`.
 */

#include "board.h"
#include "link.h"
#include "meshsweep.h"

#define KEEP 5.0f /* distance to keep, mm */
/* No point of the arm moves farther from one pose to the next. So the distance is kept between them
 * too. */
#define MOST_PER_POSE 1.5f
#define STEPS 2000 /* pairs of nodes that the question about a pose may open */
#define LENGTH 60.0f /* from axis to axis of a link */

enum { POSES = 128, LINKS = 3 };

static msw_scratch_entry scratch[MSW_DISTANCE_ENTRIES];
static msw_tight hull;
static msw_model surface; /* of the hull */

/* Turned about its first axis, which is at x and z. `half` is the tangent of half the angle: a
 * rotation without sines. */
static msw_placed turned(float half, float x, float z)
{
    const float cosine = (1.0f - half * half) / (1.0f + half * half);
    const float sine = 2.0f * half / (1.0f + half * half);
    const msw_placed placed = {
        &surface,
        {{{cosine, 0, -sine}, {0, 1, 0}, {sine, 0, cosine}}, {x, 0, z}},
    };
    return placed;
}

static int32_t run(void)
{
    int32_t error = msw_open_tight(&hull, link_bytes, LINK_BYTES, MSW_FINEST);
    if (error == MSW_OK) {
        error = msw_tight_model(&surface, &hull);
    }
    static const uint32_t joint[1][2] = {{0, 1}};
    const msw_budget budget = {.steps = STEPS};
    uint32_t most_pairs = 0, worst = 0;
    for (uint32_t number = 0; number < POSES && error == MSW_OK; number++) {
        /* Upper arm, forearm, and the link in the way. */
        const float half = 0.25f - (float)number / 256.0f;
        msw_placed links[LINKS];
        links[0] = turned(half, 0, 0);
        links[1] = turned(1.5f * half, LENGTH * links[0].pose.rotation[0][0],
                          LENGTH * links[0].pose.rotation[2][0]);
        links[2] = turned(0, 40, -50);
        msw_models_answer near;
        const uint32_t from = clock_count();
        error = msw_models_within(links, LINKS, KEEP + MOST_PER_POSE, joint, 1, &budget, scratch,
                                  MSW_DISTANCE_ENTRIES, &near);
        const uint32_t took = clock_count() - from;
        worst = took > worst ? took : worst;
        most_pairs = near.work.opened > most_pairs ? near.work.opened : most_pairs;
        if (error == MSW_OK && !msw_is_clear(near.verdict)) {
            print_line("stopped before pose ", number, "");
            if (near.models[0] == MSW_NO_MODEL) {
                print("  it is not known which links may be too near\n");
            } else {
                print_line("  link ", near.models[0], "");
                print_line("  and link ", near.models[1], " may be too near");
            }
            break;
        }
        /* Here the arm moves. */
    }
    if (error != MSW_OK) {
        return error;
    }
    print_line("most pairs of nodes that a pose opened: ", most_pairs, "");
    print_line("cost: the worst pose took ", worst, clock_unit);
    return MSW_OK;
}

int main(void)
{
    const int32_t error = run();
    if (error != MSW_OK) {
        print(msw_strerror(error));
    }
    return error != MSW_OK;
}
