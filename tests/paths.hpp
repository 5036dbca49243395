// SPDX-License-Identifier: Apache-2.0
// Where things lie that a test reads or starts. Only paths.cpp knows, so that the other objects are the same
// for every build that they run against and in every checkout, where a compiler cache finds them again.
#pragma once

#include <string>

namespace parallax::test {

/// `name` in the checkout that was built, for example "platform/presets".
std::string source_path(const std::string& name);

/// `name` in the development data beside the checkout, which need not be there.
std::string shared_data(const std::string& name);

/// The program of the build that the test runs against.
std::string program_path();

/// Whether that build has sanitizers in it.
bool sanitized();

}  // namespace parallax::test
