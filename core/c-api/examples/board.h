/* What the examples need of a board. cortex-m4/startup.c has it for a Cortex-M4F, host.c for a
 * workstation. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Writes text as it is. */
void print(const char *text);

/* Writes a number in decimal. */
void print_number(uint32_t number);

/* A line: text, a number, text. */
static inline void print_line(const char *before, uint32_t number, const char *after)
{
    print(before);
    print_number(number);
    print(after);
    print("\n");
}

/* Milliseconds since the start. */
uint32_t periods(void);

/* Sleeps until periods() is not `period` any more. */
void sleep_during(uint32_t period);

/* Instructions since the start, as QEMU counts them; on a workstation microseconds. Wraps around:
 * only differences mean something. */
uint32_t clock_count(void);

/* Its unit, after a space. */
extern const char clock_unit[];

/* How many of them a period of 1 ms has. An instruction counts as a cycle. */
extern const uint32_t clock_in_period;

#endif
