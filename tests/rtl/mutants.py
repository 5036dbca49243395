# SPDX-License-Identifier: Apache-2.0
"""Changes that break the reference circuits, each with the patterns of `parallax compare` that would be right for it, written down before
any was run: what kind of mistake it is says what should be told of it."""
import collections

Mutant = collections.namedtuple("Mutant", "circuit file old new pattern place equivalent")

# Where a circuit has not the name of its stage.
STAGES = {"median_3x3": "noise_reduction"}

# circuit: for each set of vectors the options of parallax vectors, and the parameters. What one does not meet, another does: costs that
# are equal, all of them or nearly, offsets that leave the image, disparities at its border.
FLAT = "--left flat.pgm --right flat.pgm"  # images.py
NOISE = "--left noise_left.pgm --right noise_right.pgm"
TWELVE = "-s matching.parallelism=4 -s matching.iterations=3"
MEDIAN = "-s noise_reduction.kind=median_3x3 -s subpixel.mask_border=false"
SIZE = ".WIDTH(32), .HEIGHT(16)"
BENCHES = {
    "census": [("--size 32x16 -d 32 --frames 2", SIZE)],
    "matching": [(f"--size 32x16 --frames 2 {TWELVE}", f"{SIZE}, .P(4), .ITERATIONS(3)")],
    "subpixel": [
        (f"--size 32x16 --frames 2 {TWELVE}", f"{SIZE}, .P(4), .ITERATIONS(3)"),
        (f"{FLAT} {TWELVE}", f"{SIZE}, .P(4), .ITERATIONS(3)"),
    ],
    "uniqueness": [
        (f"--size 32x16 --frames 2 {TWELVE}", f"{SIZE}, .P(4), .ITERATIONS(3)"),
        (f"--size 32x16 {TWELVE} -s uniqueness.factor=256", f"{SIZE}, .P(4), .ITERATIONS(3), .FACTOR(256)"),
        (f"{NOISE} {TWELVE}", f"{SIZE}, .P(4), .ITERATIONS(3)"),
    ],
    "rectification": [
        ("--size 32x16 -d 32 --frames 2 -s rectification.window=9", f"{SIZE}, .WINDOW(9), .OFFSET_BITS(9)"),
        ("--size 32x48 -d 32 -s rectification.window=15", ".WIDTH(32), .HEIGHT(48), .WINDOW(15), .OFFSET_BITS(9)"),
    ],
    "noise_reduction": [("--size 32x16 -d 32 --frames 2 -s subpixel.mask_border=false", SIZE)],
    "median_3x3": [
        (f"--size 32x16 -d 32 --frames 2 {MEDIAN}", SIZE),
        (f"{NOISE} -d 32 {MEDIAN}", SIZE),
    ],
}

# Kinds of mistakes, and the patterns that are right for each.
HANDSHAKE = {"handshake"}  # the test bench names the port, or tokens are lost or moved
MOVED = {"token_lost", "tokens_lost", "token_doubled", "tokens_inserted", "truncated", "surplus", "constant_latency"}
MOVED |= {"row_lost", "rows_lost", "row_doubled", "rows_inserted", "column_lost", "column_doubled", "every_second", "each_twice"}
MOVED |= {"tokens_doubled", "column_inserted"}
COLUMN = {"one_column_late", "one_column_early", "constant_latency", "token_lost", "token_doubled"}
ROW = {"one_row_late", "one_row_early", "constant_latency", "tokens_lost", "tokens_inserted", "row_lost", "row_doubled"}
BORDER = {"only_rim", "only_first_rows", "only_last_rows", "only_first_columns", "only_last_columns"}
BORDER |= {"one_row", "one_column"}  # where it is one too many or too few that are taken for the border
STATE = {"rows_after_first", "columns_after_first", "frames_after_first"}  # what comes from before
LANE = {"one_disparity", "only_first_disparity", "only_last_disparity", "one_group", "one_field"}
COMPARISON = {"inverted_comparison", "inverted"}
TIES = {"only_set_bits", "only_cleared_bits"}  # of a comparison that takes equal values for less, or does not
EXCHANGED = {"exchanged_streams", "input_unchanged"}
BIT = {"one_bit", "top_bits_lost", "saturated"}
ORDER = {"bit_order", "byte_order", "field_order"}
OFFSET = {"constant_offset"}
CONSTANT = {"constant", "unknown_bits"}
# Other values here and there: nothing that they have in common, but perhaps that the rim passes unchanged, or by how much they differ.
VALUES = {"none", "all_but_rim", "only_validity", "invalid_as", "off_by_one", "upper_bits"}

# (file, old, new, patterns[, place])
CENSUS = [
    ("census_image.sv", "all_right[AT*8 +: 8] < all_right", "all_right[AT*8 +: 8] > all_right", COMPARISON, {"row": 0}),
    ("census_image.sv", "all_right[AT*8 +: 8] < all_right", "all_right[AT*8 +: 8] >= all_right", COMPARISON, {"row": 0}),
    ("census_image.sv", "all_right[AT*8 +: 8] < all_right", "all_right[AT*8 +: 8] <= all_right", TIES),
    ("census_image.sv", "comparisons[CODE_BITS-1-i]", "comparisons[i]", ORDER, {"row": 0}),
    ("census_image.sv", "i < CODE_BITS / 2 ? i : i + 1", "i <= CODE_BITS / 2 ? i : i + 1", BIT),
    ("census_image.sv", "PLACE % WINDOW_WIDTH * WINDOW_HEIGHT + PLACE / WINDOW_WIDTH", "PLACE", ORDER | VALUES),
    ("census_image.sv", "WINDOW_WIDTH / 2 * WINDOW_HEIGHT + WINDOW_HEIGHT / 2", "WINDOW_WIDTH / 2 * WINDOW_HEIGHT", VALUES),
    ("census_image.sv", ".exists(raw_rows)", ".exists({WINDOW_HEIGHT{1'b1}})", BORDER, {"row": 0, "column": 0}),
    ("census_image.sv", ".exists(rows_right_columns)", ".exists({WINDOW_WIDTH{1'b1}})", BORDER, {"row": 0, "column": 0}),
    ("census_image.sv", "raw_columns <= columns_exist", "raw_columns <= raw_columns", BORDER | CONSTANT | VALUES),
    ("census_image.sv", "if (moves[2]) all_right", "if (moves[1]) all_right", VALUES | MOVED),
    ("census_image.sv", "if (moves[3]) compared", "compared", VALUES | MOVED),
    ("in_image.sv", "at >= 16'(REACH - i)", "at > 16'(REACH - i)", BORDER, {"row": 0}),
    ("in_image.sv", "at < 16'(SIZE + REACH - i)", "at <= 16'(SIZE + REACH - i)", BORDER),
    ("in_image.sv", "at < 16'(SIZE + REACH - i)", "at < 16'(SIZE + REACH - i - 1)", BORDER),
    ("nearest_in_image.sv", "filled[(i+1)*BITS +: BITS];", "'0;", BORDER, {"row": 0}),
    ("nearest_in_image.sv", "filled[(i-1)*BITS +: BITS];", "'0;", BORDER),
    ("raster_window.sv", "at == AT_BITS'(WIDTH - 1)", "at == AT_BITS'(WIDTH - 2)", ROW | STATE | VALUES),
    ("raster_window.sv", "above <= lines[next]", "above <= lines[at]", COLUMN | STATE | VALUES),
    ("raster_window.sv", "{above[KEPT-BITS-1:0], pixel}", "{above[KEPT-BITS-1:0], 8'd0}", STATE | VALUES),
    ("raster_window.sv", "above[(ROWS-2-r)*BITS +: BITS]", "above[r*BITS +: BITS]", VALUES | STATE),
    ("raster_window.sv", "window = {column, held}", "window = {held, column}", VALUES | COLUMN),
    ("census.sv", ".AHEAD(WINDOW_HEIGHT / 2 * WIDTH + WINDOW_WIDTH / 2)", ".AHEAD(WINDOW_HEIGHT / 2 * WIDTH + 1)", COLUMN, {"row": 0}),
    ("census.sv", ".AHEAD(WINDOW_HEIGHT / 2 * WIDTH + WINDOW_WIDTH / 2)", ".AHEAD(WINDOW_HEIGHT / 2 * WIDTH + 3)", COLUMN, {"row": 0}),
    ("census.sv", ".AHEAD(WINDOW_HEIGHT / 2 * WIDTH + WINDOW_WIDTH / 2)", ".AHEAD(WIDTH + WINDOW_WIDTH / 2)", ROW, {"row": 0}),
    ("census.sv", ".pixel(in_right_data)", ".pixel(in_left_data)", EXCHANGED),
    ("census.sv", "in_left_ready = may_fire && reads && in_right_valid", "in_left_ready = may_fire && reads", HANDSHAKE),
    ("census.sv", "inputs_valid = !reads || both_valid", "inputs_valid = !reads || in_left_valid", HANDSHAKE),
    ("output_pair.sv", "b_valid = valid && !b_done", "b_valid = valid", HANDSHAKE),
    ("output_pair.sv", "valid && !ready && (a_done || a_ready)", "valid && (a_done || a_ready)", HANDSHAKE),
    ("output_pair.sv", "(b_done || b_ready);", "b_ready;", HANDSHAKE),
    ("output_pair.sv", "ready = (a_ready || a_done) && (b_ready || b_done)", "ready = (a_ready || a_done)", HANDSHAKE),
    ("stage_control.sv", "fires = may_fire && inputs_valid", "fires = may_fire", HANDSHAKE),
    ("stage_control.sv", "(!produces || moves[0])", "1'b1", HANDSHAKE),
    ("stage_control.sv", "out_ready || full[LATENCY-1:i] != {(LATENCY - i) {1'b1}}", "1'b1", HANDSHAKE),
    ("stage_control.sv", "phase == PHASE_BITS'(PIXELS + AHEAD - 1)", "phase == PHASE_BITS'(PIXELS + AHEAD)", STATE | MOVED | HANDSHAKE),
    ("stage_control.sv", "x == X_BITS'(WIDTH - 1) ? '0", "x == X_BITS'(WIDTH) ? '0", VALUES | STATE | BORDER),
    ("stage_control.sv", "y == Y_BITS'(HEIGHT - 1) ? '0", "y == Y_BITS'(HEIGHT) ? '0", {"frames_after_first"}, {"frame": 1}),
    ("stage_control.sv", "begun > (PHASE_BITS + 1)'(AHEAD)", "begun >= (PHASE_BITS + 1)'(AHEAD)", COLUMN | MOVED),
    ("stage_control.sv", "phase < PHASE_BITS'(PIXELS)", "phase <= PHASE_BITS'(PIXELS)", STATE | MOVED | HANDSHAKE),
    ("stage_control.sv", "full[0] <= fires && produces", "full[0] <= fires", MOVED),
    ("stage_control.sv", "full[k] <= full[k-1]", "full[k] <= full[0]", HANDSHAKE),
]
MATCHING = [
    ("path_unit.sv", "WIDE'(below) + WIDE'(P1)", "WIDE'(below)", VALUES | STATE),
    ("path_unit.sv", "WIDE'(above) + WIDE'(P1)", "WIDE'(above) + WIDE'(P2)", VALUES | STATE),
    ("path_unit.sv", "WIDE'(minimum) + WIDE'(P2)", "WIDE'(minimum) + WIDE'(P1)", VALUES | STATE),
    ("path_unit.sv", "WIDE'(minimum) + WIDE'(P2)", "WIDE'(P2)", VALUES | STATE),
    ("path_unit.sv", "best - WIDE'(minimum)", "best", VALUES | STATE),
    ("path_unit.sv", "starts ? cost : cost + PATH_BITS'(added)", "cost + PATH_BITS'(added)", CONSTANT | BORDER | VALUES, {"row": 0, "column": 0}),
    ("path_unit.sv", "starts ? cost : cost + PATH_BITS'(added)", "starts ? cost + 1'b1 : cost + PATH_BITS'(added)", VALUES | OFFSET, {"row": 0, "column": 0}),
    ("path_unit.sv", "has_below = !first_group", "has_below = 1'b1", LANE | VALUES | STATE),
    ("path_unit.sv", "has_below = !first_group", "has_below = 1'b0", VALUES | STATE),
    ("path_unit.sv", "has_above = !last_group", "has_above = 1'b1", LANE | VALUES | STATE),
    ("path_unit.sv", "group[(j-1)*PATH_BITS +: PATH_BITS]", "group[j*PATH_BITS +: PATH_BITS]", VALUES | STATE),
    ("path_unit.sv", "group[(j+1)*PATH_BITS +: PATH_BITS]", "group[(j-1)*PATH_BITS +: PATH_BITS]", VALUES | STATE),
    ("path_unit.sv", "group[(P-1)*PATH_BITS +: PATH_BITS]", "group[0 +: PATH_BITS]", VALUES | STATE),
    ("path_unit.sv", "next_group[0 +: PATH_BITS]", "group[0 +: PATH_BITS]", VALUES | STATE),
    ("path_unit.sv", "first_group || group_minimum", "group_minimum", CONSTANT | VALUES | STATE),
    ("path_unit.sv", "group_minimum < minimum_so_far", "group_minimum > minimum_so_far", VALUES | STATE),
    ("path_unit.sv", "pixel_ends = step && last_group", "pixel_ends = step", VALUES | STATE | CONSTANT),
    ("path_unit.sv", "from_below < stay_or_jump ? from_below", "from_below > stay_or_jump ? from_below", VALUES | STATE),
    ("path_unit.sv", "WIDE'(same) < jump", "WIDE'(same) > jump", VALUES | STATE),
    ("lowest_of.sv", "takes_b = b < a", "takes_b = b > a", VALUES | STATE),
    ("lowest_of.sv", "lowest = takes_b ? b : a", "lowest = a", VALUES | STATE),
    ("step_delay.sv", "AT_BITS'(WORDS - 2);", "AT_BITS'(WORDS - 3);", VALUES | STATE | ROW | COLUMN),
    ("step_delay.sv", "write_at == AT_BITS'(WORDS - 1)", "write_at == AT_BITS'(WORDS - 2)", VALUES | STATE | ROW | CONSTANT),
    ("step_delay.sv", "oldest <= second", "oldest <= held[read_at]", VALUES | STATE),
    ("step_delay.sv", "current = held[(WORDS-1)*BITS +: BITS]", "current = held[0 +: BITS]", VALUES | STATE),
    ("matching.sv", ".DELAY(WIDTH + 1)", ".DELAY(WIDTH + 2)", VALUES | STATE),
    ("matching.sv", ".DELAY(WIDTH)", ".DELAY(WIDTH + 1)", VALUES | STATE),
    ("matching.sv", ".DELAY(WIDTH - 1)", ".DELAY(WIDTH)", VALUES | STATE),
    ("matching.sv", "north_west_starts = at_top || at_left", "north_west_starts = at_top", STATE | VALUES),
    ("matching.sv", "north_east_starts = at_top || at_right", "north_east_starts = at_top", STATE | VALUES | BORDER),
    ("matching.sv", ".starts(at_left)", ".starts(at_right)", CONSTANT | VALUES | STATE),
    ("matching.sv", "column == 16'd0 ? {D{in_right_data}} : shifted", "column == 16'd1 ? {D{in_right_data}} : shifted", CONSTANT | VALUES),
    ("matching.sv", "{D{in_right_data}}", "{D*CODE_BITS{1'b0}}", VALUES | BORDER | STATE),
    ("matching.sv", "codes_of = codes[i*P*CODE_BITS +: P*CODE_BITS]", "codes_of = codes[0 +: P*CODE_BITS]", VALUES | LANE),
    ("matching.sv", "left_0 ^ right_0", "left_0 & right_0", VALUES),
    ("matching.sv", "i < CODE_BITS; i = i + 1) ones", "i < CODE_BITS - 1; i = i + 1) ones", VALUES),
    ("matching.sv", "? bits << 1 : '0", "? bits : '0", VALUES),
    ("matching.sv", "step = moves[2] && full[1]", "step = moves[2]", VALUES | STATE),
    ("matching.sv", "step = moves[2] && full[1]", "step = full[1]", VALUES | STATE),
    ("matching.sv", "place_1 <= place_0", "place_1 <= place", VALUES | STATE | CONSTANT),
    ("matching.sv", "SUM_BITS'(north_east_2[i*PATH_BITS +: PATH_BITS])", "SUM_BITS'(north_2[i*PATH_BITS +: PATH_BITS])", VALUES | STATE),
    ("matching.sv", "row == 16'd0}", "row == 16'd1}", VALUES | CONSTANT | STATE),
    ("matching.sv", "inputs_valid = !first_group || both_valid", "inputs_valid = both_valid", HANDSHAKE),
    ("matching.sv", "in_left_ready = may_fire && first_group", "in_left_ready = may_fire", HANDSHAKE),
    ("stage_control.sv", "at == GROUP_BITS'(GROUPS - 1)", "at == GROUP_BITS'(GROUPS)", HANDSHAKE),
    ("pass_registers.sv", "if (moves[i]) data[i*BITS", "if (moves[0]) data[i*BITS", HANDSHAKE),
]
SUBPIXEL = [
    ("subpixel.sv", "first_group || lowest < best", "lowest < best", CONSTANT | VALUES | STATE),
    ("subpixel.sv", "lowest < best", "lowest <= best", VALUES),
    ("subpixel.sv", "lowest < best", "lowest > best", VALUES),
    ("subpixel.sv", "column < 16'(BORDER_WIDTH)", "column <= 16'(BORDER_WIDTH)", BORDER, {"row": 2, "column": 2}),
    ("subpixel.sv", "column >= 16'(WIDTH - BORDER_WIDTH)", "column > 16'(WIDTH - BORDER_WIDTH)", BORDER, {"row": 2, "column": 30}),
    ("subpixel.sv", "row < 16'(BORDER_HEIGHT)", "row < 16'(BORDER_WIDTH - 1)", BORDER, {"row": 1, "column": 2}),
    ("subpixel.sv", "row >= 16'(HEIGHT - BORDER_HEIGHT)", "row >= 16'(HEIGHT)", BORDER, {"row": 14, "column": 2}),
    ("subpixel.sv", "below_index + 9'd2", "below_index + 9'd1", VALUES),
    ("subpixel.sv", "base_of = 8'(k * P)", "base_of = 8'(k)", VALUES),
    ("subpixel.sv", "above_comes ? in_costs_data", "1'b0 ? in_costs_data", VALUES),
    ("subpixel.sv", "wins && index == 8'(P - 1)", "wins && index == 8'(P)", VALUES),
    ("subpixel.sv", "best_below <= now_below", "best_below <= below", VALUES),
    ("subpixel.sv", "last_cost <= in_costs_data[(P-1)*COST_BITS +: COST_BITS]", "last_cost <= in_costs_data[0 +: COST_BITS]", VALUES),
    ("subpixel.sv", "up_0 = below_0 > above_0", "up_0 = below_0 < above_0", VALUES),
    ("subpixel.sv", "now_at != 8'd0 &&", "", VALUES),
    ("subpixel.sv", "8'(P * ITERATIONS - 1)", "8'(P * ITERATIONS)", VALUES),
    ("subpixel.sv", "lower_0, 3'd0}", "lower_0, 3'd4}", VALUES),
    ("subpixel.sv", "<< (3 - i)", "<< (2 - i)", VALUES),
    ("subpixel.sv", "rest_in >= part", "rest_in > part", VALUES),
    ("subpixel.sv", "&& rest_in != '0", "", VALUES),
    ("subpixel.sv", "12'hfff", "12'h7ff", BIT | BORDER, {"row": 0, "column": 0}),
    ("subpixel.sv", "up ? whole + fraction : whole - fraction", "whole + fraction", VALUES),
    ("subpixel.sv", "up ? whole + fraction : whole - fraction", "whole", VALUES),
    ("subpixel.sv", "in_costs_ready = may_fire", "in_costs_ready = fires || last_group", HANDSHAKE),
    ("subpixel.sv", "at_0 + 8'(OFFSET)", "at_0 + 8'(OFFSET + 1)", OFFSET | VALUES, {"row": 2, "column": 2}),
    ("lowest_of.sv", "takes_b = b < a", "takes_b = b <= a", VALUES),
    ("lowest_of.sv", "b_index + 8'(LOW)", "b_index", VALUES),
]
UNIQUENESS = [
    ("uniqueness.sv", "side_1 < rival_side_1", "side_1 > rival_side_1", VALUES | COMPARISON),
    ("uniqueness.sv", "side_1 < rival_side_1", "side_1 <= rival_side_1", VALUES | EXCHANGED),
    ("uniqueness.sv", "SIDE_BITS'(FACTOR)", "SIDE_BITS'(FACTOR + 128)", VALUES),
    ("uniqueness.sv", "{5'd0, rival_0, 8'd0}", "{5'd0, best_0, 8'd0}", CONSTANT, {"row": 2}),
    ("uniqueness.sv", "index == 8'(j) ||", "", CONSTANT, {"row": 2}),
    ("uniqueness.sv", "(j > 0 && index == 8'(j - 1)) ||", "", VALUES),
    ("uniqueness.sv", "|| index == 8'(j + 1)", "", VALUES),
    ("uniqueness.sv", "j == 0 && best_was_last ? NONE", "1'b0 ? NONE", VALUES),
    ("uniqueness.sv", "index == 8'd0 ? all_but_last : all_earlier", "all_earlier", VALUES),
    ("uniqueness.sv", "index == 8'd0 ? all_but_last : all_earlier", "all_but_last", VALUES),
    ("uniqueness.sv", "j == P - 1 ? NONE : cost", "j == P ? NONE : cost", VALUES),
    ("uniqueness.sv", "first_group || lowest < best", "lowest < best", VALUES | CONSTANT | STATE),
    ("uniqueness.sv", "all_earlier = first_group ? NONE : earlier", "all_earlier = earlier", VALUES | CONSTANT | STATE),
    ("uniqueness.sv", "lower(rival, lowest_upper)", "lowest_upper", VALUES),
    ("uniqueness.sv", "disparity_1 : 12'hfff", "12'hfff : disparity_1", VALUES | COMPARISON),
    ("uniqueness.sv", "disparity_1 <= disparity_0", "disparity_1 <= in_disparity_data", COLUMN | VALUES | CONSTANT),
    ("uniqueness.sv", "in_disparity_ready = may_fire && last_group && in_costs_valid", "in_disparity_ready = may_fire && last_group", HANDSHAKE),
    ("uniqueness.sv", "in_costs_ready = may_fire && (!last_group || in_disparity_valid)", "in_costs_ready = may_fire", HANDSHAKE),
    ("uniqueness.sv", ".WRITES_LAST(1)", ".WRITES_LAST(0)", MOVED),
]
RECTIFICATION = [
    ("bilinear.sv", "offset >>> FRACTION_BITS", "offset >> FRACTION_BITS", VALUES),
    ("bilinear.sv", "clamped = 16'd0", "clamped = 16'd1", BORDER | VALUES),
    ("bilinear.sv", "clamped = size - 16'd1", "clamped = size - 16'd2", BORDER | VALUES),
    ("bilinear.sv", "next_x = x + 18'd1", "next_x = x", VALUES),
    ("bilinear.sv", "next_y = y + 18'd1", "next_y = y + 18'd2", VALUES),
    ("bilinear.sv", "at + 18'(SLOTS)", "at", VALUES | STATE | CONSTANT),
    ("bilinear.sv", "(SQUARE_SUM + 1)'(S * S / 2)", "(SQUARE_SUM + 1)'(0)", VALUES | OFFSET),
    ("bilinear.sv", "ROW_SUM'(S) - ROW_SUM'(f)", "ROW_SUM'(f)", VALUES),
    ("bilinear.sv", "rounded[2*FRACTION_BITS +: 8]", "rounded[2*FRACTION_BITS-1 +: 8]", VALUES | BIT),
    ("bilinear.sv", "fy_5 <= fy_4", "fy_5 <= fx_4", VALUES),
    ("bilinear.sv", "slot_0 <= slot", "slot_0 <= write_slot", VALUES | ROW),
    ("pixel_square.sv", "even_column = left_column[0] ? right_column", "even_column = left_column[0] ? left_column", VALUES),
    ("pixel_square.sv", "odd_slot = upper_slot[0] ? upper_slot", "odd_slot = upper_slot[0] ? lower_slot", VALUES),
    ("pixel_square.sv", "column[0] == (i % 2 != 0)", "column[0] == (i % 2 == 0)", VALUES | COLUMN),
    ("pixel_square.sv", "first_of[write_row] + ", "", VALUES | STATE | CONSTANT | ROW),
    ("pixel_square.sv", "odd_1[3] ? read[15:8] : read[7:0]", "read[7:0]", VALUES),
    ("pixel_square.sv", "odd_1 <= odd_0", "odd_1 <= {left_column[0], right_column[0], upper_slot[0], lower_slot[0]}", VALUES),
    ("rectification.sv", "pixel_comes = fires && reads", "pixel_comes = fires", STATE | VALUES | BORDER),
    ("rectification.sv", "in_map_data[OFFSET_BITS +: OFFSET_BITS]", "in_map_data[0 +: OFFSET_BITS]", VALUES),
    ("rectification.sv", "in_map_ready = may_fire && writes &&", "in_map_ready = may_fire &&", HANDSHAKE),
    ("rectification.sv", "(!writes || in_map_valid);\n  stage_control", "1'b1;\n  stage_control", HANDSHAKE),
    ("rectification.sv", "slot == SLOT_BITS'(SLOTS - 1) ? '0 : slot", "slot == SLOT_BITS'(SLOTS - 2) ? '0 : slot", VALUES | STATE | ROW),
]
NOISE_REDUCTION = [
    ("noise_reduction.sv", "difference <= 12'(MAX_DIFFERENCE)", "difference < 12'(MAX_DIFFERENCE)", VALUES),
    ("noise_reduction.sv", "difference <= 12'(MAX_DIFFERENCE)", "difference >= 12'(MAX_DIFFERENCE)", VALUES),
    ("noise_reduction.sv", "exists && value != INVALID", "value != INVALID", BORDER, {"row": 0}),
    ("noise_reduction.sv", "centre_0 - value : value - centre_0", "value - centre_0 : value - centre_0", VALUES),
    ("noise_reduction.sv", "(PLACES/2)*12 +: 12", "(PLACES/2 - 1)*12 +: 12", ROW, {"row": 0}),
    ("noise_reduction.sv", "columns_0[i / WINDOW] && rows_0", "columns_0[i % WINDOW] && rows_0", BORDER | VALUES),
    ("noise_reduction.sv", "counted[k] ? SUM_BITS'", "1'b1 ? SUM_BITS'", VALUES),
    ("noise_reduction.sv", "+ (SUM_BITS + 1)'(number_3)", "", OFFSET | VALUES),
    ("noise_reduction.sv", "POINT'((1 << POINT) / (2 * n) + 1)", "POINT'((1 << POINT) / (2 * n + 1) + 1)", VALUES),
    ("noise_reduction.sv", "centre_5 == INVALID ? INVALID", "1'b0 ? INVALID", VALUES | CONSTANT),
    ("noise_reduction.sv", "product_5[POINT +: 12]", "product_5[POINT-1 +: 12]", VALUES),
    ("noise_reduction.sv", "number_4 <= number_3", "number_4 <= all_of(numbers_2)", VALUES | COLUMN),
    ("noise_reduction.sv", "inputs_valid = !reads || in_disparity_valid", "inputs_valid = 1'b1", HANDSHAKE),
    ("noise_reduction.sv", ".AHEAD(REACH * WIDTH + REACH)", ".AHEAD(REACH * WIDTH + REACH + 1)", COLUMN, {"row": 0}),
]
MEDIAN_3X3 = [
    ("sort_three.sv", "falls = b < a", "falls = b > a", VALUES),
    ("sort_three.sv", "highest = c < higher", "highest = c > higher", VALUES),
    ("sort_three.sv", "swaps = other < lower", "swaps = other > lower", VALUES),
    ("median_3x3.sv", "column != 16'd0 &&", "", BORDER, {"row": 1, "column": 0}),
    ("median_3x3.sv", "column != 16'(WIDTH - 1)", "column != 16'(WIDTH)", BORDER, {"row": 1, "column": 31}),
    ("median_3x3.sv", "row != 16'd0 &&", "", BORDER, {"row": 0}),
    ("median_3x3.sv", "row != 16'(HEIGHT - 1)", "row != 16'(HEIGHT)", BORDER, {"row": 15}),
    ("median_3x3.sv", ".AHEAD(WIDTH + 1)", ".AHEAD(WIDTH)", COLUMN, {"row": 0}),
    ("median_3x3.sv", ".AHEAD(WIDTH + 1)", ".AHEAD(2 * WIDTH + 1)", ROW, {"row": 0}),
    ("median_3x3.sv", "shifted[4*12 +: 12]", "shifted[3*12 +: 12]", BORDER, {"row": 0}),
    ("median_3x3.sv", "shifted[6*12 +: 3*12]", "shifted[3*12 +: 3*12]", VALUES | STATE),
    ("median_3x3.sv", "ordered[6*12 +: 12]", "ordered[8*12 +: 12]", VALUES),
    ("median_3x3.sv", "ordered[4*12 +: 12]", "ordered[5*12 +: 12]", VALUES),
    ("median_3x3.sv", "ordered[2*12 +: 12]", "ordered[0 +: 12]", VALUES),
    ("median_3x3.sv", "middle[12 +: 12]", "middle[0 +: 12]", VALUES),
    ("median_3x3.sv", "if (fires) sorted_columns", "sorted_columns", VALUES | STATE | MOVED),
    ("median_3x3.sv", "sorted_columns[6*12-1:3*12]", "sorted_columns[3*12-1:0]", VALUES | STATE),
    ("median_3x3.sv", "window_0[(6+r)*12 +: 12]", "window_0[(3+r)*12 +: 12]", VALUES),
    ("median_3x3.sv", "covered_1 <= covered_0", "covered_1 <= covered", BORDER | VALUES),
    ("median_3x3.sv", "centre_1 <= centre_0", "centre_1 <= shifted[4*12 +: 12]", BORDER),
    ("median_3x3.sv", "if (moves[1]) begin", "if (moves[0]) begin", VALUES | MOVED),
    ("median_3x3.sv", "in_disparity_ready = may_fire && reads", "in_disparity_ready = may_fire", HANDSHAKE),
    ("median_3x3.sv", "inputs_valid = !reads || in_disparity_valid", "inputs_valid = 1'b1", HANDSHAKE),
]
# These leave every value as it is.
EQUIVALENT = [
    ("census", "stage_control.sv", "busy <= busy - 1'b1", "busy <= '0", "with an interval of 1 there is nothing to wait for"),
    ("matching", "path_unit.sv", "WIDE'(same) < jump", "WIDE'(same) <= jump", "equal values, whichever is taken"),
    ("matching", "lowest_of.sv", "takes_b = b < a", "takes_b = b <= a", "the index of the lowest cost is not used"),
    ("subpixel", "subpixel.sv", "up_0 = below_0 > above_0", "up_0 = below_0 >= above_0", "between equal costs the fraction is 0"),
    ("noise_reduction", "noise_reduction.sv", "value != INVALID &&", "", "no disparity of a range of 32 is within 24 of the invalid one"),
    ("noise_reduction", "noise_reduction.sv", "value < centre_0 ?", "value <= centre_0 ?", "the difference of equal values is 0"),
    ("median_3x3", "sort_three.sv", "falls = b < a", "falls = b <= a", "equal values, whichever comes first"),
    ("median_3x3", "sort_three.sv", "swaps = other < lower", "swaps = other <= lower", "equal values, whichever comes first"),
]


def all_mutants():
    lists = {
        "census": CENSUS,
        "matching": MATCHING,
        "subpixel": SUBPIXEL,
        "uniqueness": UNIQUENESS,
        "rectification": RECTIFICATION,
        "noise_reduction": NOISE_REDUCTION,
        "median_3x3": MEDIAN_3X3,
    }
    for circuit, changes in lists.items():
        for file, old, new, pattern, *place in changes:
            yield Mutant(circuit, file, old, new, pattern, place[0] if place else {}, "")
    for circuit, file, old, new, reason in EQUIVALENT:
        yield Mutant(circuit, file, old, new, set(), {}, reason)


MUTANTS = list(all_mutants())
