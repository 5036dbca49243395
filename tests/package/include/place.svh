// Of a byte in a burst.
`define PLACE_BITS 7
