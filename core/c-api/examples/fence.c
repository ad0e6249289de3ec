/* An autopilot asks its geofence 50 times a second: is it inside, and how far is the line? The same
 * program in Rust: core/examples/fence.
 *
 * The fence is a field with two exclusion zones, a house and a mast. While the distance to the
 * nearest line is proved to be larger than the way of braking, the vehicle flies on. An undecided
 * side brakes too.
 */

#include "board.h"
#include "meshsweep.h"
#include "zones.h"

#define PERIOD 20u /* from tick to tick, ms: 50 Hz */

/* Distance to keep, m: 24.4 to brake from 15.6 m/s by 5 m/s^2, 0.3 until the next tick, 2.5 for the
 * receiver of positions, and some room. */
#define KEEP 28.0f

/* Nodes that a question may open: it bounds the time. An answer that is cut short holds. */
static const msw_budget budget = {0.0f, 0.0f, 64};

/* A straight leg: its start and its way from tick to tick, in 64ths of a metre, and its ticks. */
struct leg {
    int32_t start[2];
    int32_t step[2];
    uint32_t ticks;
};

enum { LEGS = 5 };
static const struct leg legs[LEGS] = {
    {{60 * 64, 120 * 64}, {20, 0}, 900},    /* East, past the house to the mast. */
    {{200 * 64, 60 * 64}, {0, -20}, 900},   /* South, to the line. */
    {{370 * 64, 120 * 64}, {0, 16}, 900},   /* Along the line, to a corner. */
    {{300 * 64, 150 * 64}, {-20, 0}, 900},  /* From the mast. */
    {{200 * 64, 180 * 64}, {-12, -16}, 250} /* Across the field. */
};

static msw_scratch_entry scratch[ZONES_SCRATCH_ENTRIES];
ZONES_CHECK_SCRATCH(scratch);

static msw_curve fence;

/* Instructions of the costliest question. */
static uint32_t worst;

/* Flies a leg, and prints what it comes to. */
static int32_t fly(uint32_t number, const struct leg *leg)
{
    int32_t x = leg->start[0], y = leg->start[1];
    print_line("leg ", number, "");
    for (uint32_t tick = 0; tick < leg->ticks; tick++) {
        const float place[2] = {(float)x * (1.0f / 64.0f), (float)y * (1.0f / 64.0f)};
        msw_curve_signed found;
        const uint32_t from = clock_count();
        const int32_t error = msw_curve_signed_distance(&fence, place, &budget, scratch,
                                                        ZONES_SCRATCH_ENTRIES, &found);
        const uint32_t took = clock_count() - from;
        worst = took > worst ? took : worst;
        if (error != MSW_OK) {
            return error;
        }
        if (found.side != MSW_SIDE_INSIDE) {
            print_line("  is not proved to be inside after ms: ", tick * PERIOD, "");
            return MSW_OK;
        }
        /* Negative inside: no line is nearer than this. */
        const float left = -found.distance.upper;
        if (left < KEEP) {
            print_line("  brakes after ms: ", tick * PERIOD, "");
            print_line("  millimetres left, for certain: ", (uint32_t)(left * 1000.0f), "");
            print_line("  the nearest line is of zone ", found.closest.polyline, "");
            return MSW_OK;
        }
        x += leg->step[0];
        y += leg->step[1];
    }
    print_line("  is flown to its end in ms: ", leg->ticks * PERIOD, "");
    return MSW_OK;
}

static int32_t run(void)
{
    int32_t error = msw_open_curve(&fence, zones_bytes, ZONES_BYTES);
    if (error == MSW_OK) {
        error = msw_curve_check_fence(&fence);
    }
    for (uint32_t number = 0; error == MSW_OK && number < LEGS; number++) {
        error = fly(number + 1, &legs[number]);
    }
    if (error == MSW_OK) {
        print_line("cost: the worst question took ", worst, clock_unit);
        print_line("cost: a period has ", PERIOD * clock_in_period, clock_unit);
    }
    return error;
}

int main(void)
{
    const int32_t error = run();
    if (error != MSW_OK) {
        print(msw_strerror(error));
    }
    return error != MSW_OK;
}
