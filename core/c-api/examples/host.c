/* Output on this machine. */

#include <stdio.h>

void print(const char *text);

void print(const char *text)
{
    puts(text);
}
