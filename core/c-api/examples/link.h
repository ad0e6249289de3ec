/* The blob `link.msw` of `link.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile link.c
 * with your program. Give link_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a question takes in libmeshsweep_small.a /
 * libmeshsweep.a, without the frame of its msw_ function:
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   open tight hulls                3200 / 2944    3136 / 3008    3200 / 2944    3136 / 2880
 *   closest point of tight hulls    3328 / 3456    4224 / 4288    3328 / 3456    3904 / 3904
 *   within of tight hulls           3264 / 3328    4160 / 4288    3264 / 3328    3904 / 3904
 */
#ifndef LINK_MSW_H
#define LINK_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LINK_BYTES 1202u /* of the blob */
#define LINK_CHECKSUM 0x47f6d005u /* by msw_checksum; covers all sections */
#define LINK_TRIANGLES 284u /* of the mesh */
#define LINK_SCRATCH_ENTRIES 12u /* no question about a point or a segment needs more */
#define LINK_BOX_LOW {-8.503906f, -0.00390625f, -8.310547f} /* of a box that contains the mesh */
#define LINK_BOX_HIGH {66.00391f, 8.003906f, 8.310547f} /* of a box that contains the mesh */
#define LINK_TIGHT_HULLS 1u /* coarse to fine, for msw_open_tight */

/* The blob; it begins at a multiple of four. */
extern const uint8_t link_bytes[LINK_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * msw_overlap and msw_models_within need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define LINK_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= LINK_SCRATCH_ENTRIES, \
        "too few scratch entries for link")
#else
#define LINK_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= LINK_SCRATCH_ENTRIES, \
        "too few scratch entries for link")
#endif

#ifdef __cplusplus
}
#endif

#endif
