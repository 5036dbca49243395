#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SystemC 2.3.4 (Debian's libsystemc 2.3.4-2) tells the address sanitizer of every switch between its stacks, but says of the
# main program's that it is at null and 0 bytes large. From the first thread process on the sanitizer takes the main stack for
# a foreign one: an exception thrown and caught in a method process leaves its redzones behind, and the next one in a shallower
# frame ends a correct program with a stack-buffer-overflow in sigaltstack(). Guessed before: that libsystemc, not built with
# the sanitizer, tells it nothing.
set -euo pipefail

version=2.3.4-2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -o APT::Sandbox::User=root download "libsystemc=$version" "libsystemc-dev=$version" >/dev/null
for package in *.deb; do dpkg-deb -x "$package" .; done
library=$(dirname "$(find "$folder" -name 'libsystemc-*.so' | head -1)")

cat >model.cpp <<'CPP'
#include <cstdio>
#include <stdexcept>
#include <systemc>

#ifdef WATCH
extern "C" void __sanitizer_start_switch_fiber(void**, const void* bottom, size_t size) {
  std::printf("switch to a stack %s, %zu bytes\n", bottom ? "at an address" : "at null", size);
}
extern "C" void __sanitizer_finish_switch_fiber(void*, const void**, size_t*) {}
#endif

__attribute__((noinline)) void fail(int depth) {
  char text[200];
  std::snprintf(text, sizeof text, "%d", depth);
  if (depth == 0) throw std::runtime_error(text);
  fail(depth - 1);
  std::puts(text);
}

struct Model : sc_core::sc_module {
  sc_core::sc_event go;
  SC_HAS_PROCESS(Model);
  explicit Model(sc_core::sc_module_name name) : sc_module(name) {
    SC_THREAD(first);
    SC_METHOD(second);
    sensitive << go;
    dont_initialize();
  }
  void first() {
    wait(1, sc_core::SC_NS);
    go.notify();
  }
  void second() {
    for (int depth = 12; depth >= 0; --depth) {
      try {
        fail(depth);
      } catch (const std::runtime_error&) {
      }
    }
  }
};

int sc_main(int, char**) {
  Model model("model");
  sc_core::sc_start();
  std::puts("all caught");
  return 0;
}
CPP
build() {
  g++ -std=c++17 -O1 "$@" model.cpp -isystem usr/include -L"$library" -lsystemc -Wl,-rpath,"$library"
}
run() {
  ASAN_OPTIONS=detect_leaks=0${1:+:$1} ./a.out >out 2>&1 && echo "exit 0" >>out || echo "exit $?" >>out
}
expect() {
  grep -q "$1" out || { echo "changed: not seen with $2: $1" && cat out && exit 1; }
  echo "$2: $(grep -m1 "$1" out | sed 's/^==[0-9]*==//; s/0x[0-9a-f]*/ADDRESS/g')"
}

g++ --version | head -1
build && run && expect "all caught" "without the sanitizer"
build -fsanitize=address && run && expect "ERROR: AddressSanitizer: stack-buffer-" "with it"
expect "in .*sigaltstack" "where"
build -fsanitize=address -DWATCH && run && expect "at null, 0 bytes" "what it is told"
echo "interceptor_name:sigaltstack" >suppressions
build -fsanitize=address && run suppressions=suppressions && expect "all caught" "with that interceptor suppressed"
