// The unpacking of bursts into pixels, in the place of the model's.
`include "place.svh"
module own_circuit (
  input clk, input rst, input [1023:0] in_bursts_data, input in_bursts_valid, in_bursts_first, in_bursts_last,
  output in_bursts_ready, output [7:0] out_tokens_data, output out_tokens_valid, input out_tokens_ready);
  reg [`PLACE_BITS - 1:0] at;
  assign out_tokens_data = in_bursts_data[at * 8 +: 8];
  assign out_tokens_valid = in_bursts_valid;
  assign in_bursts_ready = out_tokens_ready && at == 7'd`LAST;
  always @(posedge clk) at <= rst ? 7'd0 : at + {6'd0, out_tokens_valid && out_tokens_ready};
endmodule
