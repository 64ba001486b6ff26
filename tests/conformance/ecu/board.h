#ifndef BOARD_H
#define BOARD_H
#include <stdint.h>

void say(const char* text);
void say_number(uint32_t number);
uint32_t ticks(void); /* 24 bits, in proportion to the instructions executed */

#endif
