// SPDX-License-Identifier: Apache-2.0
// Part of what is built with AddressSanitizer, which has to know which stack a program is on: what is thrown
// on another one leaves its frames marked, and what is called next is taken for an overflow. The SystemC
// kernel runs its threads on stacks of their own and announces every switch, but libsystemc 2.3.4 announces
// the one back to the main stack as "null, 0 bytes" (findings/systemc_main_stack_asan.sh), and that of a
// thread that ends not at all. So the first is passed on with the main stack's bounds, and whatever is thrown
// on the main stack announces it once more.
#include <dlfcn.h>
#include <pthread.h>

#include <cstddef>
#include <cstdint>
#include <typeinfo>

namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t size = 0;
};

Stack own_stack() {
  Stack stack;
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return stack;
  pthread_attr_getstack(&attributes, &stack.bottom, &stack.size);
  pthread_attr_destroy(&attributes);
  return stack;
}

// Of the main thread, in which the kernel runs: of the one that starts the program.
const Stack kMain = own_stack();

template <class Function>
Function next_of(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

using Start = void (*)(void**, const void*, std::size_t);
using Finish = void (*)(void*, const void**, std::size_t*);
const char* const kStart = "__sanitizer_start_switch_fiber";
const char* const kFinish = "__sanitizer_finish_switch_fiber";

// Tells the sanitizer that this is the main stack, if it is.
void announce_main_stack() {
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  const auto bottom = reinterpret_cast<std::uintptr_t>(kMain.bottom);
  if (here < bottom || here >= bottom + kMain.size) return;
  static const auto start = next_of<Start>(kStart);
  static const auto finish = next_of<Finish>(kFinish);
  start(nullptr, kMain.bottom, kMain.size);
  finish(nullptr, nullptr, nullptr);
}

}  // namespace

extern "C" {

void __sanitizer_start_switch_fiber(void** fake_stack, const void* bottom, std::size_t size) {
  static const auto start = next_of<Start>(kStart);
  const bool back = bottom == nullptr;
  start(fake_stack, back ? kMain.bottom : bottom, back ? kMain.size : size);
}

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*destructor)(void*)) {
  static const auto next = next_of<void (*)(void*, std::type_info*, void (*)(void*))>("__cxa_throw");
  announce_main_stack();
  next(thrown, type, destructor);
  __builtin_unreachable();
}

[[noreturn]] void __cxa_rethrow() {
  static const auto next = next_of<void (*)()>("__cxa_rethrow");
  announce_main_stack();
  next();
  __builtin_unreachable();
}

}  // extern "C"
