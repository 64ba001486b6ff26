/* Start, clock and voice of a Cortex-M4F that qemu makes: floating point on, SysTick as a counter
 * of instructions, words out by semihosting. */
#include "board.h"

extern uint32_t data_load, data_start, data_end, bss_start, bss_end, stack_top;

int main(void);

static uint32_t semihosting(uint32_t operation, uintptr_t argument) {
  register uint32_t r0 __asm__("r0") = operation;
  register uintptr_t r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

static void stop(int code) {
  const uint32_t reason[2] = {0x20026, (uint32_t)code}; /* the application ended */
  semihosting(0x20, (uintptr_t)reason);
  for (;;) {
  }
}

void fault(void) {
  say("FAULT\n");
  stop(2);
}

void reset(void) {
  uint32_t *from = &data_load, *to;
  *(volatile uint32_t*)0xE000ED88 |= 0xFU << 20; /* CPACR: floating point */
  for (to = &data_start; to < &data_end;) *to++ = *from++;
  for (to = &bss_start; to < &bss_end;) *to++ = 0;
  *(volatile uint32_t*)0xE000E014 = 0xFFFFFF; /* SysTick counts down from here */
  *(volatile uint32_t*)0xE000E018 = 0;
  *(volatile uint32_t*)0xE000E010 = 5;
  stop(main());
}

__attribute__((section(".vectors"), used)) static const void* const kVectors[16] = {
    &stack_top, (void*)reset, (void*)fault, (void*)fault, (void*)fault, (void*)fault, (void*)fault};

void say(const char* text) { semihosting(0x04, (uintptr_t)text); }

void say_number(uint32_t number) {
  char text[12];
  int at = 11;
  text[at] = '\0';
  do {
    text[--at] = (char)('0' + (number % 10));
    number /= 10;
  } while (number > 0);
  say(" ");
  say(&text[at]);
}

uint32_t ticks(void) { return 0xFFFFFF - *(volatile uint32_t*)0xE000E018; }
