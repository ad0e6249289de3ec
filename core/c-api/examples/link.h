/* The blob `link.msw` of `link.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile link.c
 * with your program. Give link_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   msw_open_tight                  3136 / 2688    3264 / 2816    3136 / 2688    3072 / 2688
 *   msw_tight_within                2688 / 2816    3776 / 3840    2688 / 2816    3136 / 3200
 *   msw_tight_model                   384 / 384      384 / 384      384 / 384      320 / 320
 *   msw_checksum                     1088 / 896     1088 / 960     1088 / 896      960 / 832
 *   msw_pose_of_quaternion            192 / 256      320 / 384      192 / 256      192 / 320
 *   msw_pose_then                     320 / 512      640 / 832      320 / 512      512 / 704
 *   msw_pose_inverse                  576 / 448      768 / 768      576 / 448      704 / 640
 *   msw_pose_relative_to              640 / 448      832 / 768      640 / 448      704 / 704
 *   msw_pose_motion                   128 / 128      192 / 192      128 / 128      128 / 128
 */
#ifndef LINK_MSW_H
#define LINK_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LINK_BYTES 1214u /* of the blob */
#define LINK_CHECKSUM 0xfd904fb2u /* by msw_checksum; covers all sections */
#define LINK_TRIANGLES 284u /* of the mesh */
#define LINK_SCRATCH_ENTRIES 13u /* no question about a point or a segment needs more */
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
