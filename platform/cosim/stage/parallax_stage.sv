// SPDX-License-Identifier: Apache-2.0
// What parallax_stage.h declares, for a test bench: parallax_stage::open("census", "--size 64x48").
`timescale 1ns / 1ps

package parallax_stage;
  localparam int WIDTH = 8192;  // bits that a token may have; the port's width of them count
  typedef bit [WIDTH-1:0] token;
  typedef logic [WIDTH-1:0] logic_token;

  import "DPI-C" parallax_stage_open = function chandle open(input string stage, input string options);
  import "DPI-C" parallax_stage_message = function string message(input chandle stage);
  import "DPI-C" parallax_stage_width = function int width(input chandle stage, input string port);
  import "DPI-C" parallax_stage_push = function int push(input chandle stage, input string port, input token data);
  import "DPI-C" parallax_stage_pop = function int pop(input chandle stage, input string port, output token data);
  import "DPI-C" parallax_stage_check = function int check(input chandle stage, input string port, input logic_token data);
  import "DPI-C" parallax_stage_finish = function int finish(input chandle stage);
  import "DPI-C" parallax_stage_close = function void close(input chandle stage);
endpackage
