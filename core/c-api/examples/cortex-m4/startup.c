/* Start-up of a Cortex-M4F, time by SysTick, and output to a debugger or to QEMU (semihosting).
 * Nothing of a C library is needed. */

#include "../board.h"

/* Processor clock of mps2-an386. For your board write its own. */
#define CLOCK_HZ 25000000u
/* Ticks of a millisecond. */
#define PERIOD (CLOCK_HZ / 1000u)
/* In QEMU an instruction takes 1 ns, and a tick 40. On a board write 1: a tick is a cycle. */
#define PER_TICK 40u

#define SYST_CSR ((volatile uint32_t *)0xE000E010)
#define SYST_RVR ((volatile uint32_t *)0xE000E014)
#define SYST_CVR ((volatile uint32_t *)0xE000E018)

extern uint32_t stack_top[], data_begin[], data_end[], data_in_flash[], bss_begin[], bss_end[];

int main(void);
void reset(void);
void stop(void);
void systick(void);

/* A call of the debugger: its number and its argument. */
static uintptr_t semihosting(uint32_t number, const void *argument)
{
    register uintptr_t r0 __asm__("r0") = number;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void print(const char *text)
{
    static uintptr_t console;
    uintptr_t length = 0;
    while (text[length] != 0) {
        length++;
    }
    if (console == 0) {
        /* SYS_OPEN of the console, for writing. */
        const uintptr_t open[3] = {(uintptr_t) ":tt", 4, 3};
        console = semihosting(0x01, open);
    }
    /* SYS_WRITE. */
    const uintptr_t block[3] = {console, (uintptr_t)text, length};
    semihosting(0x05, block);
}

void print_number(uint32_t number)
{
    char digits[11];
    char *first = &digits[10];
    *first = 0;
    do {
        *--first = (char)('0' + number % 10);
        number /= 10;
    } while (number != 0);
    print(first);
}

static volatile uint32_t interrupts;

void systick(void)
{
    interrupts++;
}

uint32_t periods(void)
{
    return interrupts;
}

/* A pending interrupt ends the sleep although it is masked. So none is missed between the
 * comparison and the sleep. */
void sleep_during(uint32_t period)
{
    while (interrupts == period) {
        __asm__ volatile("cpsid i" ::: "memory");
        if (interrupts == period) {
            __asm__ volatile("wfi");
        }
        __asm__ volatile("cpsie i" ::: "memory");
    }
}

const char clock_unit[] = " instructions";
const uint32_t clock_in_period = 25000; /* at 25 MHz */

uint32_t clock_count(void)
{
    uint32_t now, left;
    do {
        now = interrupts;
        left = *SYST_CVR;
    } while (interrupts != now);
    /* The interrupt comes at 0. The next tick has PERIOD - 1 left. */
    return (now * PERIOD + (PERIOD - left) % PERIOD) * PER_TICK;
}

static void leave(int status)
{
    /* SYS_EXIT_EXTENDED with ADP_Stopped_ApplicationExit. */
    const uint32_t block[2] = {0x20026, (uint32_t)status};
    semihosting(0x20, block);
    for (;;) {
    }
}

void stop(void)
{
    leave(2);
}

void reset(void)
{
    const uint32_t *from = data_in_flash;
    for (uint32_t *to = data_begin; to != data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_begin; to != bss_end; to++) {
        *to = 0;
    }
    /* CPACR: the floating-point unit, which the library's hard-float code uses. */
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb");
    /* The processor's clock, with an interrupt each period. */
    *SYST_RVR = PERIOD - 1;
    *SYST_CVR = 0;
    *SYST_CSR = 7;
    leave(main());
}

/* The processor reads the stack and the entry from here; every fault stops. SysTick is the last. */
__attribute__((section(".vectors"), used)) static const uintptr_t vectors[16] = {
    (uintptr_t)stack_top, (uintptr_t)reset, (uintptr_t)stop, (uintptr_t)stop,
    (uintptr_t)stop,      (uintptr_t)stop,  (uintptr_t)stop, [15] = (uintptr_t)systick,
};
