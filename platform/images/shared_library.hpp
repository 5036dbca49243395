// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace parallax {

/// A shared library that is loaded when it is first needed, and stays.
class SharedLibrary {
 public:
  /// NAME as the loader knows it ("libm.so.6"). Throws std::runtime_error if it cannot be loaded.
  explicit SharedLibrary(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr)
      throw std::runtime_error(fmt::format("cannot load a shared library: {}", dlerror()));
  }

  /// The function with the linker's name SYMBOL, whose type the caller answers for. Throws std::runtime_error
  /// if the library has none.
  template <class Function>
  Function* function(const char* symbol) const {
    void* const found = dlsym(handle_, symbol);
    if (found == nullptr)
      throw std::runtime_error(fmt::format("another shared library is expected: {}", dlerror()));
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* handle_;
};

}  // namespace parallax
