/* The blob in flash. -Wa,-I names its folder, -DPART="groove.msw" another file. */
#ifndef PART
#define PART "groove.msw"
#endif

    .section .rodata.part_blob, "a"
    .global part_blob, part_blob_end
    .balign 4
part_blob:
    .incbin PART
part_blob_end:

#ifdef __linux__
    .section .note.GNU-stack, "", %progbits
#endif
