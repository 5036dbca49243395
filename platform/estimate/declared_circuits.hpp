// SPDX-License-Identifier: Apache-2.0
// Circuits that there is no reference of: counted from their declared widths and storage and by the family's
// rules (circuit.rule.*). Nothing was synthesised to hold them against.
#pragma once

#include "platform/config/machine_config.hpp"
#include "platform/estimate/reference_circuits.hpp"

namespace parallax {

CircuitEstimate map_decoder_circuit(const StageCircuit& stage, int offset_bits, int word_bits,
                                    const DeviceFile& device);
/// The right winners of the disparities under way, and the disparities that wait for them.
CircuitEstimate consistency_circuit(const CostCircuit& circuit, int look_ahead_pixels,
                                    const DeviceFile& device);
CircuitEstimate texture_circuit(const StageCircuit& stage, const TextureConfig& config,
                                const DeviceFile& device);
CircuitEstimate speckle_circuit(const StageCircuit& stage, const SpeckleConfig& config,
                                const DeviceFile& device);
CircuitEstimate gap_interpolation_circuit(const StageCircuit& stage, const GapInterpolationConfig& config,
                                          const DeviceFile& device);
/// A filter of which its storage alone is known: as if it were lines.
CircuitEstimate stored_bits_circuit(const std::string& name, const StageCircuit& stage, std::int64_t bits,
                                    const DeviceFile& device);
/// Between bursts and tokens: a burst in a memory of the port's words, and a shifter of a word and a token,
/// or of two words.
CircuitEstimate burst_circuit(const DmaPortConfig& port, std::int64_t token_bits, const DeviceFile& device);
/// A DMA engine: its buffer, an address, a length, and a count of bursts under way.
CircuitEstimate engine_circuit(const DmaPortConfig& port, const DeviceFile& device);

}  // namespace parallax
