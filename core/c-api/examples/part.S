/* The blob in flash. -Wa,-I names its folder, -DPART="groove.msw" another file. */
#ifndef PART
#define PART "groove.msw"
#endif

    .section .rodata.part_blob, "a"
    .global part_blob, part_blob_bytes
    .balign 4
part_blob:
    .incbin PART
0:
    .balign 4
part_blob_bytes:
    .long 0b - part_blob

#ifdef __linux__
    .section .note.GNU-stack, "", %progbits
#endif
