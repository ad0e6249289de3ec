/* The blob `groove_pad.msw` of `groove.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile groove_pad.c
 * with your program. Give groove_pad_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   msw_open_sdf                    1664 / 1536    1728 / 1536    1664 / 1536    1600 / 1408
 *   msw_sdf_distance                  320 / 256      512 / 512      320 / 256      320 / 320
 *   msw_sdf_distance_and_gradient      448 / 384      704 / 640      448 / 384      384 / 384
 *   msw_sdf_within                    384 / 320      576 / 576      384 / 320      384 / 320
 *   msw_sdf_units_of                  192 / 192      320 / 384      192 / 192      256 / 256
 *   msw_sdf_distance_in_units         256 / 192      320 / 256      256 / 192      192 / 192
 *   msw_sdf_gradient_in_units         320 / 320      384 / 320      320 / 320      256 / 256
 *   msw_checksum                     1088 / 896     1088 / 960     1088 / 896      960 / 832
 *   msw_pose_of_quaternion            192 / 256      320 / 448      192 / 256      192 / 320
 *   msw_pose_then                     640 / 512      832 / 832      640 / 512      704 / 768
 *   msw_pose_inverse                  576 / 448      768 / 768      576 / 448      640 / 640
 *   msw_pose_relative_to              640 / 448      768 / 768      640 / 448      704 / 704
 *   msw_pose_motion                   128 / 128      192 / 192      128 / 128      128 / 128
 */
#ifndef GROOVE_PAD_MSW_H
#define GROOVE_PAD_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GROOVE_PAD_BYTES 2161u /* of the blob */
#define GROOVE_PAD_CHECKSUM 0x86c11474u /* by msw_checksum; covers all sections */
#define GROOVE_PAD_TRIANGLES 404u /* of the mesh */
#define GROOVE_PAD_SCRATCH_ENTRIES 1u /* no question about a point or a segment needs more */
#define GROOVE_PAD_SDF_UNIT 0.0022461165f /* of the distance field, in the mesh's unit */

/* The blob; it begins at a multiple of four. */
extern const uint8_t groove_pad_bytes[GROOVE_PAD_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * Questions about models need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define GROOVE_PAD_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= GROOVE_PAD_SCRATCH_ENTRIES, \
        "too few scratch entries for groove_pad")
#else
#define GROOVE_PAD_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= GROOVE_PAD_SCRATCH_ENTRIES, \
        "too few scratch entries for groove_pad")
#endif

#ifdef __cplusplus
}
#endif

#endif
