// SPDX-License-Identifier: Apache-2.0
#include "traces/metric_bytes.hpp"

#include <fmt/format.h>

#include <protozero/exception.hpp>
#include <protozero/pbf_message.hpp>
#include <protozero/pbf_writer.hpp>
#include <protozero/varint.hpp>

namespace parallax {
namespace {

enum class GroupField : protozero::pbf_tag_type { kName = 1, kMetric = 2, kGroup = 3 };
// A value is in the field of its kind; a row of numbers may be empty.
enum class MetricField : protozero::pbf_tag_type {
  kName = 1,
  kUnit = 2,
  kDescription = 3,
  kWindow = 4,
  kWhole = 5,
  kReal = 6,
  kWord = 7,
  kTruth = 8,
  kWholes = 9,
};

constexpr protozero::pbf_tag_type tag(MetricField field) {
  return static_cast<protozero::pbf_tag_type>(field);
}
constexpr protozero::pbf_tag_type tag(GroupField field) {
  return static_cast<protozero::pbf_tag_type>(field);
}

struct ValueWriter {
  protozero::pbf_writer& out;
  void operator()(std::int64_t whole) { out.add_sint64(tag(MetricField::kWhole), whole); }
  void operator()(double real) { out.add_double(tag(MetricField::kReal), real); }
  void operator()(const std::string& word) { out.add_string(tag(MetricField::kWord), word); }
  void operator()(bool truth) { out.add_bool(tag(MetricField::kTruth), truth); }
  // One by one would lose an empty row.
  void operator()(const std::vector<std::int64_t>& wholes) {
    std::string packed;
    for (const std::int64_t whole : wholes)
      protozero::add_varint_to_buffer(&packed, protozero::encode_zigzag64(whole));
    out.add_bytes(tag(MetricField::kWholes), packed);
  }
};

void write(const Metric& metric, protozero::pbf_writer& out) {
  out.add_string(tag(MetricField::kName), metric.name);
  out.add_string(tag(MetricField::kUnit), metric.unit);
  out.add_string(tag(MetricField::kDescription), metric.description);
  out.add_string(tag(MetricField::kWindow), metric.window);
  std::visit(ValueWriter{out}, metric.value);
}

void write(const MetricGroup& group, protozero::pbf_writer& out) {
  out.add_string(tag(GroupField::kName), group.name);
  for (const Metric& metric : group.metrics) {
    protozero::pbf_writer part(out, tag(GroupField::kMetric));
    write(metric, part);
  }
  for (const MetricGroup& child : group.groups) {
    protozero::pbf_writer part(out, tag(GroupField::kGroup));
    write(child, part);
  }
}

Metric read_metric(protozero::pbf_message<MetricField> in) {
  Metric metric;
  while (in.next()) {
    switch (in.tag()) {
      case MetricField::kName:
        metric.name = in.get_string();
        break;
      case MetricField::kUnit:
        metric.unit = in.get_string();
        break;
      case MetricField::kDescription:
        metric.description = in.get_string();
        break;
      case MetricField::kWindow:
        metric.window = in.get_string();
        break;
      case MetricField::kWhole:
        metric.value = in.get_sint64();
        break;
      case MetricField::kReal:
        metric.value = in.get_double();
        break;
      case MetricField::kWord:
        metric.value = in.get_string();
        break;
      case MetricField::kTruth:
        metric.value = in.get_bool();
        break;
      case MetricField::kWholes: {
        const auto range = in.get_packed_sint64();
        metric.value = std::vector<std::int64_t>(range.begin(), range.end());
        break;
      }
      default:
        in.skip();
    }
  }
  return metric;
}

MetricGroup read_group(protozero::pbf_message<GroupField> in) {
  MetricGroup group;
  while (in.next()) {
    switch (in.tag()) {
      case GroupField::kName:
        group.name = in.get_string();
        break;
      case GroupField::kMetric:
        group.metrics.push_back(read_metric(protozero::pbf_message<MetricField>(in.get_message())));
        break;
      case GroupField::kGroup:
        group.groups.push_back(read_group(protozero::pbf_message<GroupField>(in.get_message())));
        break;
      default:
        in.skip();
    }
  }
  return group;
}

}  // namespace

std::string to_bytes(const MetricGroup& group) {
  std::string bytes;
  protozero::pbf_writer out(bytes);
  write(group, out);
  return bytes;
}

MetricGroup metrics_from_bytes(std::string_view bytes) try {
  return read_group(protozero::pbf_message<GroupField>(bytes.data(), bytes.size()));
} catch (const protozero::exception& error) {
  throw MetricError(fmt::format("these bytes are no metrics: {}", error.what()));
}

}  // namespace parallax
