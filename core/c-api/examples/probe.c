/* How far is the tip of a probe from a part, 1,000 times a second and in bounded time? The same
 * program in Rust: core/examples/probe.
 *
 * The part is a block of 40 by 40 by 30 with a slot. groove.h and groove.c hold its blob, by
 * `meshsweep build groove.obj -o groove.msw --for closest,segment,cull,winding --emit c`. The tip
 * comes down on the slot, which is 4 wide, and keeps 2 away from the part, so it stops at the
 * mouth. It never moves farther than half of what the last answer proved free.
 */

#include "board.h"
#include "groove.h"
#include "meshsweep.h"

#define KEEP 2.0f  /* distance to keep, mm */
#define FEED 0.04f /* most motion in a period, mm: 40 mm a second */

/* So many entries are always enough. Fewer do not compile. */
static msw_scratch_entry scratch[GROOVE_SCRATCH_ENTRIES];
GROOVE_CHECK_SCRATCH(scratch);

static msw_model part;

static uint32_t um(float mm)
{
    return (uint32_t)(mm * 1000.0f);
}

/* Comes down as far as answers prove that it may. A question opens at most so many nodes: that
 * bounds its time. */
static int32_t descend(uint32_t steps)
{
    const msw_budget budget = {.steps = steps};
    float tip[3] = {20.0f, 20.0f, 60.0f};
    uint32_t cut_short = 0, late = 0, worst = 0, questions = 0;
    msw_closest near;
    for (;;) {
        const uint32_t period = periods(), from = clock_count();
        const int32_t error = msw_closest_point(&part, tip, &budget, scratch,
                                                GROOVE_SCRATCH_ENTRIES, &near);
        if (error != MSW_OK) {
            return error;
        }
        const uint32_t took = clock_count() - from;
        worst = took > worst ? took : worst;
        questions++;
        /* If the steps ended the search, the interval is wider. Its lower end still holds. */
        cut_short += near.ended != MSW_ENDED_EXACT;
        const float free = near.distance.lower - KEEP;
        if (free < 0.01f) {
            break;
        }
        tip[2] -= 0.5f * free < FEED ? 0.5f * free : FEED;
        /* QEMU's clock runs slower than a processor. */
        late += took > clock_in_period || periods() != period;
        sleep_during(period);
    }
    print_line("at most ", steps, " nodes a question");
    print_line("  stopped at a height of ", um(tip[2]), " um");
    print_line("  the part is from ", um(near.distance.lower), " um");
    print_line("  to ", um(near.distance.upper) + 1, " um away");
    print_line("  questions: ", questions, "");
    print_line("  cut short by the budget: ", cut_short, "");
    print_line("  longer than their period of 1 ms: ", late, "");
    print_line("cost: the worst of them took ", worst, clock_unit);
    return MSW_OK;
}

int main(void)
{
    /* Checks every byte. If something else guards the flash, msw_open_trusted is quicker. */
    int32_t error = msw_open(&part, groove_bytes, GROOVE_BYTES);
    /* Few steps prove less, so the tip stops earlier. It is never too near. */
    if (error == MSW_OK) {
        error = descend(2);
    }
    if (error == MSW_OK) {
        error = descend(16);
    }
    if (error != MSW_OK) {
        print(msw_strerror(error));
    }
    return error != MSW_OK;
}
