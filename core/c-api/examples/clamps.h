/* The blob `clamps.msw` of `clamps.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile clamps.c
 * with your program. Give clamps_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                               
 *   msw_open                    
 *   msw_open_trusted            
 *   msw_closest_point           
 *   msw_closest_point_from      
 *   msw_coherent_closest_point  
 *   msw_within                  
 *   msw_nearest                 
 *   msw_signed_distance         
 *   msw_first_hit               
 *   msw_overlap                 
 *   msw_within_of               
 *   msw_distance                
 *   msw_coherent_pair_distance  
 *   msw_coherent_pair_within    
 *   msw_first_contact_of        
 *   msw_scene_begin             
 *   msw_scene_move              
 *   msw_scene_within            
 *   msw_solid_first_contact     
 *   msw_checksum                
 *   msw_pose_of_quaternion      
 *   msw_pose_then               
 *   msw_pose_inverse            
 *   msw_pose_relative_to        
 *   msw_pose_motion             
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
#define CLAMPS_IS_CLOSED 1 /* whether the mesh is closed */
#define CLAMPS_HAS_SIDES 1 /* whether msw_signed_distance decides sides */
#define CLAMPS_SURFACE_ERROR 0.0f /* most distance of the mesh from the stored surface */
#define CLAMPS_BOX_LOW {0.0f, 0.0f, 0.0f} /* of a box that contains the mesh */
#define CLAMPS_BOX_HIGH {100.0f, 16.0f, 28.0f} /* of a box that contains the mesh */

/* The blob; it begins at a multiple of four. */
extern const uint8_t clamps_bytes[CLAMPS_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * Questions about models need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
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
