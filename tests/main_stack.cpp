// SPDX-License-Identifier: Apache-2.0
// Part of what is built with AddressSanitizer. The SystemC kernel runs each of its threads on a stack of its
// own and announces every switch; libsystemc 2.3.4 announces the one back to the main stack as "null, 0
// bytes" (findings/systemc_main_stack_asan.sh). Whatever is thrown there later leaves its frames marked, and
// what is called next is taken for an overflow. So the announcement is taken here, and passed on with the
// main stack's bounds.
#include <dlfcn.h>
#include <pthread.h>

#include <cstddef>

namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t size = 0;
};

// Of the main thread, in which the kernel runs.
Stack main_stack() {
  Stack stack;
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return stack;
  pthread_attr_getstack(&attributes, &stack.bottom, &stack.size);
  pthread_attr_destroy(&attributes);
  return stack;
}

}  // namespace

extern "C" void __sanitizer_start_switch_fiber(void** fake_stack, const void* bottom, std::size_t size) {
  using Announce = void (*)(void**, const void*, std::size_t);
  static const auto announce = reinterpret_cast<Announce>(dlsym(RTLD_NEXT, "__sanitizer_start_switch_fiber"));
  static const Stack main = main_stack();
  const bool back = bottom == nullptr;
  announce(fake_stack, back ? main.bottom : bottom, back ? main.size : size);
}
