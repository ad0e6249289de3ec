/* The blob `clamps.msw` of `clamps.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile clamps.c
 * with your program. Give clamps_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a question takes in libmeshsweep_small.a /
 * libmeshsweep.a, without the frame of its msw_ function:
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   open a box tree                 2560 / 2240    2688 / 2368    2560 / 2240    2496 / 2240
 *   closest point                   1280 / 1216    2112 / 2048    1280 / 1216    1920 / 1728
 *   closest point from a hint       1280 / 1152    2048 / 2048    1280 / 1152    1920 / 1728
 *   coherent query                  1728 / 1664    2624 / 2624    1728 / 1664    2368 / 2240
 *   closest points                  2944 / 2880    3840 / 3840    2944 / 2944    3584 / 3456
 *   within                          1792 / 1664    2624 / 2560    1792 / 1664    2432 / 2240
 *   nearest triangles               1664 / 1600    2496 / 2496    1664 / 1600    2304 / 2176
 *   all within                      1664 / 1600    2560 / 2496    1664 / 1600    2304 / 2176
 *   signed distance                 3072 / 3200    3904 / 4032    3072 / 3200    3712 / 3712
 *   first hit                       1472 / 1152    1792 / 1664    1472 / 1152    1536 / 1408
 *   any hit                         1344 / 1088    1664 / 1536    1344 / 1088    1472 / 1344
 *   all hits                        1472 / 1216    1792 / 1600    1472 / 1216    1600 / 1536
 *   overlap                         6592 / 6144    6464 / 5952    6592 / 6144    6016 / 5696
 *   distance of two models        10112 / 10432   9984 / 10048  10112 / 10432    9216 / 9472
 *   coherent pair                 12032 / 12544  11968 / 12288  12032 / 12544  11264 / 11712
 *   scene                         10816 / 11904  10688 / 11648  10816 / 11904   9984 / 11072
 *   distance of a solid           12032 / 10368  11840 / 10240  12032 / 10432   11456 / 9664
 *   first contact                 10688 / 10112   10624 / 9792  10688 / 10112   10240 / 9344
 */
#ifndef CLAMPS_MSW_H
#define CLAMPS_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CLAMPS_BYTES 918u /* of the blob */
#define CLAMPS_CHECKSUM 0x6afe8f34u /* by msw_checksum; covers all sections */
#define CLAMPS_TRIANGLES 40u /* of the mesh */
#define CLAMPS_SCRATCH_ENTRIES 13u /* no question about a point or a segment needs more */
#define CLAMPS_IS_CLOSED 1 /* whether distances have signs */
#define CLAMPS_SURFACE_ERROR 0.0f /* most distance of the mesh from the stored surface */
#define CLAMPS_BOX_LOW {0.0f, 0.0f, 0.0f} /* of a box that contains the mesh */
#define CLAMPS_BOX_HIGH {100.0f, 16.0f, 28.0f} /* of a box that contains the mesh */

/* The blob; it begins at a multiple of four. */
extern const uint8_t clamps_bytes[CLAMPS_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * msw_overlap and msw_models_within need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define CLAMPS_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= CLAMPS_SCRATCH_ENTRIES, \
        "too few scratch entries for clamps")
#else
#define CLAMPS_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= CLAMPS_SCRATCH_ENTRIES, \
        "too few scratch entries for clamps")
#endif

#ifdef __cplusplus
}
#endif

#endif
