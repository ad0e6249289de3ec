/* The blobs that answers.c asks about, from the folder that -Wa,-I names. */
    .macro blob name
    .global \name, \name\()_bytes
    .balign 4
\name:
    .incbin "\name\().msw"
0:
    .balign 4
\name\()_bytes:
    .long 0b - \name
    .endm

    .section .rodata, "a"
    blob groove
    blob hulls
    blob bracket
    blob torus
    blob fence
    blob field
    blob both
    blob bend

#ifdef __linux__
    .section .note.GNU-stack, "", %progbits
#endif
