// SPDX-License-Identifier: Apache-2.0
// The rate of machines of one's own choice, and what limits them.
#include <cstdio>
#include <systemc>

#include "modules/map_codec.hpp"
#include "platform/config/configuration.hpp"
#include "platform/evaluation/evaluate.hpp"

int sc_main(int, char**) {
  parallax::ConfigurationRequest request;
  request.preset = "scenescan-pro";
  for (const char* assignment : {"matching.iterations=4", "matching.iterations=8"}) {
    request.assignments = {assignment};
    const parallax::MachineConfig machine = parallax::load_configuration(request, {PRESETS}).machine;
    const parallax::EncodedMap map =  // of rectified images, of the processed size
        parallax::encode(parallax::identity_map(640, 480, machine.rectification.range));
    parallax::EvaluationInput input;
    input.width = map.width;
    input.height = map.height;
    input.map = &map;
    const parallax::EvaluationResult result = parallax::evaluate(machine, input);
    if (!result.done()) {
      std::fprintf(stderr, "%s: %s\n", assignment, result.message.c_str());
      return 1;
    }
    std::printf("%s: %.2f fps, %.3f ms, limit %s at %.1f %%\n", assignment, result.rate,
                result.latency.exposure_to_host, result.limit.part.c_str(), result.limit.utilisation);
  }
  return 0;
}
