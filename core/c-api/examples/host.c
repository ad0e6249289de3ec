/* Output and time on this machine. */

#include "board.h"

#include <stdio.h>
#include <time.h>

void print(const char *text)
{
    fputs(text, stdout);
}

void print_number(uint32_t number)
{
    printf("%lu", (unsigned long)number);
}

/* Nobody waits here: each call is the next period. */
static uint32_t waited;

uint32_t periods(void)
{
    return waited;
}

void sleep_during(uint32_t period)
{
    waited += waited == period;
}

const char clock_unit[] = " microseconds";
const uint32_t clock_in_period = 1000;

uint32_t clock_count(void)
{
    return (uint32_t)(clock() * (1000000 / CLOCKS_PER_SEC));
}
