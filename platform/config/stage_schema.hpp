// SPDX-License-Identifier: Apache-2.0
// The keys of the stages. The stages themselves know nothing of keys: their structs are bound here.
#pragma once

namespace parallax {

class Schema;
struct CensusConfig;
struct ConsistencyConfig;
struct GapInterpolationConfig;
struct MatchingConfig;
struct NoiseReductionConfig;
struct RectificationConfig;
struct SpeckleConfig;
struct SubpixelConfig;
struct TextureConfig;
struct UniquenessConfig;

/// Where the values come from that the device's own software shows.
inline constexpr const char* kDeviceSoftware = "parameters of the device's own software";

void describe(Schema& schema, RectificationConfig& config);
void describe(Schema& schema, CensusConfig& config);
void describe(Schema& schema, MatchingConfig& config);
void describe(Schema& schema, SubpixelConfig& config);
void describe(Schema& schema, UniquenessConfig& config);
void describe(Schema& schema, ConsistencyConfig& config);
void describe(Schema& schema, TextureConfig& config);
void describe(Schema& schema, SpeckleConfig& config);
void describe(Schema& schema, GapInterpolationConfig& config);
void describe(Schema& schema, NoiseReductionConfig& config);

}  // namespace parallax
