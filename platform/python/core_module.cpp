// SPDX-License-Identifier: Apache-2.0
// parallax._core: what the Python module takes from the libraries. Its users see parallax/*.py only.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/cli.hpp"
#include "platform/config/config_writer.hpp"
#include "platform/config/configuration.hpp"
#include "platform/config/nearest_key.hpp"
#include "platform/config/preset.hpp"
#include "platform/python/evaluated_points.hpp"
#include "platform/python/program_process.hpp"
#include "platform/python/run_process.hpp"
#include "platform/registers/run_time_parameters.hpp"
#include "platform/results/ground_truth.hpp"
#include "platform/results/result_images.hpp"
#include "platform/results/version.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace py = pybind11;

// The SystemC library asks for it; here nothing calls it.
extern "C" __attribute__((visibility("default"))) int sc_main(int, char**) { return 1; }

namespace parallax {
namespace {

// Whether Python has noted a signal, Ctrl-C above all, whose exception then waits to be thrown; whoever asks
// again is told the same.
bool signal_arrived() {
  const py::gil_scoped_acquire python;
  return PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0;
}

Configuration configuration(const std::string& preset, const std::vector<std::string>& assignments,
                            const std::optional<std::int64_t>& disparities) {
  ConfigurationRequest request;
  request.preset = preset;
  request.assignments = assignments;
  request.disparity_range = disparities;
  return load_configuration(request, preset_folders());
}

py::dict load(const std::string& preset, const std::vector<std::string>& assignments,
              const std::optional<std::int64_t>& disparities) {
  py::dict values;
  for (const EffectiveKey& key : configuration(preset, assignments, disparities).keys)
    values[(key.section + "." + key.name).c_str()] = key.value;
  return values;
}

// As `parallax config --docs --json`.
py::bytes document(const std::string& preset, const std::vector<std::string>& assignments,
                   const std::optional<std::int64_t>& disparities) {
  Configuration documented = configuration(preset, assignments, disparities);
  add_run_time_remarks(documented.keys);
  return json_text(to_json(documented, true));
}

py::tuple cause_names() {
  py::list names;
  for (const CauseStyle& style : cause_styles()) names.append(std::string(style.name));
  return names;
}

py::list presets() {
  py::list all;
  for (const PresetSummary& preset : list_presets(preset_folders()))
    all.append(py::make_tuple(preset.name, preset.description));
  return all;
}

// The pixels of an array without gaps (parallax/images.py sees to that), which outlives the result, if they
// need not be in another order.
cv::Mat matrix(const py::buffer& array) {
  const py::buffer_info info = array.request();
  const int channels = info.ndim == 3 ? static_cast<int>(info.shape[2]) : 1;
  const int depth = info.itemsize == 1 ? CV_8U : CV_16U;
  cv::Mat pixels(static_cast<int>(info.shape[0]), static_cast<int>(info.shape[1]),
                 CV_MAKETYPE(depth, channels), info.ptr);
  if (channels == 1) return pixels;
  cv::Mat as_in_files;
  cv::cvtColor(pixels, as_in_files, channels == 3 ? cv::COLOR_RGB2BGR : cv::COLOR_RGBA2BGRA);
  return as_in_files;
}

py::dict planes(const FramePlanes& frame) {
  using namespace py::literals;
  return py::dict("index"_a = frame.index, "width"_a = frame.width, "height"_a = frame.height,
                  "disparities"_a = frame.disparities, "causes"_a = frame.causes, "left"_a = frame.left,
                  "right"_a = frame.right, "truth"_a = frame.truth, "mask"_a = frame.mask);
}

py::tuple run_words(const std::vector<std::string>& words,
                    const std::vector<std::pair<py::buffer, py::buffer>>& images, bool keep_images) {
  RunRequest request{words, {}, keep_images};
  for (const auto& [left, right] : images) request.images.push_back({matrix(left), matrix(right)});
  // No other thread of Python's runs while the process is made.
  RunProcess process(std::move(request));
  for (bool over = false; !over;) {
    {
      const py::gil_scoped_release others;
      over = process.wait();
    }
    // A signal from the terminal reaches both, and the other may have ended of it.
    if (signal_arrived()) throw py::error_already_set();
  }
  RunOutcome outcome = process.outcome();
  py::list frames;
  for (const FramePlanes& frame : outcome.frames) frames.append(planes(frame));
  return py::make_tuple(outcome.code, py::bytes(outcome.timing), py::bytes(outcome.said), frames,
                        std::move(outcome.pages));
}

// (exit code, standard output, standard error) of a command of the program.
py::tuple command(const std::vector<std::string>& words) {
  ProgramProcess process(words);
  for (bool over = false; !over;) {
    {
      const py::gil_scoped_release others;
      over = process.wait();
    }
    if (signal_arrived()) throw py::error_already_set();
  }
  const ProgramOutcome outcome = process.outcome();
  return py::make_tuple(outcome.code, py::bytes(outcome.out), py::bytes(outcome.err));
}

// (status, message, notes, timing.json) of each.
py::list evaluate_words(
    const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>& words,
    unsigned processes) {
  std::vector<TimedPoint> all;
  for (const auto& [input, machine] : words) all.push_back({input, machine});
  EvaluatedPoints points(std::move(all), processes);
  std::vector<EvaluationResult> results;
  bool whole = false;
  {
    const py::gil_scoped_release others;
    const auto take = [&](std::size_t, EvaluationResult result) { results.push_back(std::move(result)); };
    whole = points.evaluate(signal_arrived, take);
  }
  if (!whole) throw py::error_already_set();
  py::list list;
  for (EvaluationResult& result : results) {
    const std::string timing = result.done() ? json_text(timing_json(result)) : "";
    py::list notes;
    for (const std::string& note : result.notes) notes.append(py::bytes(note));
    list.append(py::make_tuple(name(result.status), py::bytes(result.message), notes, py::bytes(timing)));
  }
  return list;
}

// The numbers of the score, by their names in timing.json.
py::dict score_arrays(const py::buffer& disparities, const py::buffer& truth,
                      const std::optional<py::buffer>& mask) {
  const py::buffer_info found = disparities.request(), known = truth.request();
  GroundTruth ground_truth;
  ground_truth.height = static_cast<int>(known.shape[0]);
  ground_truth.width = static_cast<int>(known.shape[1]);
  const auto* const values = static_cast<const float*>(known.ptr);
  ground_truth.disparity.assign(values, values + known.size);
  if (mask) {
    const py::buffer_info scored = mask->request();
    const auto* const bytes = static_cast<const std::uint8_t*>(scored.ptr);
    ground_truth.mask.assign(bytes, bytes + scored.size);
  }
  std::vector<Disparity> map;
  const auto* const fixed = static_cast<const std::uint16_t*>(found.ptr);
  for (py::ssize_t i = 0; i < found.size; ++i) map.push_back({fixed[i]});
  py::dict numbers;
  for (const Quality& quality : score(map, static_cast<int>(found.shape[1]), ground_truth).qualities())
    numbers[quality.name.c_str()] = quality.value;
  return numbers;
}

}  // namespace
}  // namespace parallax

PYBIND11_MODULE(_core, module) {
  using namespace parallax;
  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto set = [](const char* type, const std::string& text) {
      PyErr_SetString(py::module_::import("parallax.errors").attr(type).ptr(), one_line(text).c_str());
    };
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const py::error_already_set&) {
      throw;
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const UserError& error) {
      set("UserError", error.what());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      set("Error", error.what());
    }
  });
  py::class_<MappedPages>(module, "Pages", py::buffer_protocol()).def_buffer([](MappedPages& pages) {
    return py::buffer_info(reinterpret_cast<std::uint8_t*>(pages.data()),
                           static_cast<py::ssize_t>(pages.size()));
  });
  module.def("load", &load);
  module.def("document", &document);
  module.def("presets", &presets);
  module.def("run", &run_words);
  module.def("evaluate", &evaluate_words);
  module.def("command", &command);
  module.def("score", &score_arrays);
  module.def("nearest_key", &nearest_key);
  module.attr("causes") = cause_names();
  module.attr("version") = version();
  module.attr("revision") = revision();
  module.attr("invalid") = kInvalidDisparity;
}
