// A census circuit beside the model's stage, with pixels that no image has.
`timescale 1ns / 1ps

module census_bench;
  import parallax_stage::token, parallax_stage::logic_token;
  localparam int WIDTH = 64, HEIGHT = 48;

  logic clk = 0, rst = 1, in_valid = 0;
  logic [7:0] left, right;
  wire left_ready, right_ready, left_valid, right_valid;
  wire [23:0] left_code, right_code;
  census_5x5 #(.WIDTH(WIDTH), .HEIGHT(HEIGHT)) dut (
    .clk(clk), .rst(rst), .in_left_data(left), .in_left_valid(in_valid), .in_left_first(1'b0), .in_left_last(1'b0),
    .in_left_ready(left_ready), .in_right_data(right), .in_right_valid(in_valid), .in_right_first(1'b0),
    .in_right_last(1'b0), .in_right_ready(right_ready), .out_left_data(left_code), .out_left_valid(left_valid),
    .out_left_ready(1'b1), .out_right_data(right_code), .out_right_valid(right_valid), .out_right_ready(1'b1));
  always #5 clk = !clk;

  chandle model;
  initial begin
    model = parallax_stage::open("census", "--size 64x48");
    if (parallax_stage::message(model) != "") $fatal(1, "%s", parallax_stage::message(model));
  end

  int cycle = 0, codes = 0;
  bit fine;
  always @(posedge clk) begin
    cycle <= cycle + 1;
    rst <= cycle < 4;
    in_valid <= cycle >= 4;
    if (!in_valid || left_ready) {left, right} <= 16'($urandom());
    fine = 1;
    if (in_valid && left_ready) begin  // the pixels are taken: the model has them too
      fine &= parallax_stage::push(model, "in_left", token'(left)) == 1;
      fine &= parallax_stage::push(model, "in_right", token'(right)) == 1;
    end
    if (!rst && left_valid) begin
      fine &= parallax_stage::check(model, "out_left", logic_token'(left_code)) == 1;
      fine &= parallax_stage::check(model, "out_right", logic_token'(right_code)) == 1;
      codes <= codes + 1;
    end
    if (codes == WIDTH * HEIGHT) fine &= parallax_stage::finish(model) == 1;
    if (!fine) $fatal(1, "cycle %0d: %s", cycle, parallax_stage::message(model));
    if (codes == WIDTH * HEIGHT) begin
      parallax_stage::close(model);
      $display("PASS %0d codes of each image", codes);
      $finish;
    end
  end
endmodule
