/* Where a Cortex-M7 begins: the first entries of its table, and the floating-point unit, which is off at first. */
#include <stdint.h>

extern uint32_t __StackTop;
void _start(void);

static void begin(void) {
  *(volatile uint32_t*)0xE000ED88u |= 0xFu << 20; /* coprocessors 10 and 11 */
  __asm volatile("dsb\n isb");
  _start();
}

static void fault(void) {
  for (;;) __asm volatile("bkpt 0");
}

__attribute__((section(".vectors"), used)) static const void* const vectors[16] = {
    &__StackTop,        (const void*)begin, (const void*)fault, (const void*)fault,
    (const void*)fault, (const void*)fault, (const void*)fault,
};
