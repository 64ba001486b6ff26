/* Steps each model of models.h through the run there, by its NAME_next. Prints per model, on a
 * line: its name, the largest difference of its force from the library's in 1e-12 of the span, the
 * instructions of the longest step, and the bytes of stack that a step took. */
#include "board.h"
#include "models.h"

enum { PAINTED = 4096 };

static uint32_t ticks_of_thousand;

/* Writes a pattern below the stack's present end; returns how much of it was written over since. */
static __attribute__((noinline)) uint32_t painted(int paint) {
  volatile uint32_t room[PAINTED / 4];
  uint32_t k = 0;
  if (paint) {
    for (k = 0; k < PAINTED / 4; ++k) room[k] = 0xA5A5A5A5U;
  } else {
    while (k < PAINTED / 4 && room[k] == 0xA5A5A5A5U) ++k;
  }
  return PAINTED - 4 * k;
}

static uint32_t since(uint32_t start) { return (ticks() - start) & 0xFFFFFF; }

static void calibrate(void) {
  const uint32_t start = ticks();
  __asm__ volatile(".rept 1000\n nop\n .endr");
  ticks_of_thousand = since(start);
}

static void report(const char* name, double difference, uint32_t longest, uint32_t stack) {
  say(name);
  say_number(difference < 4e-3 ? (uint32_t)(difference * 1e12) : 4000000000U); /* rounded down */
  say_number((uint32_t)((uint64_t)longest * 1000 / ticks_of_thousand));
  say_number(stack);
  say("\n");
}

#define RUN(prefix)                                             \
  static void prefix##_run(void) {                              \
    static prefix##_model model;                                \
    double largest = 0, low = prefix##_expected[0], high = low; \
    uint32_t longest = 0, stack = 0;                            \
    int k;                                                      \
    for (k = 0; k < STEPS; ++k) {                               \
      const double expected = prefix##_expected[k];             \
      double difference;                                        \
      uint32_t start, took;                                     \
      if (k == 1) painted(1);                                   \
      start = ticks();                                          \
      difference = prefix##_next(&model, k) - expected;         \
      took = since(start);                                      \
      if (k == 1) stack = painted(0);                           \
      if (k > 0 && took > longest) longest = took;              \
      if (difference < 0) difference = -difference;             \
      if (!(difference <= largest)) largest = difference;       \
      if (expected < low) low = expected;                       \
      if (expected > high) high = expected;                     \
    }                                                           \
    report(#prefix, largest / (high - low), longest, stack);    \
  }
MODELS(RUN)

int main(void) {
#define CALL(prefix) prefix##_run();
  calibrate();
  MODELS(CALL)
  return 0;
}
