MODULE example
  RECORD pallet ! found
  ENDRECORD
ENDMODULE
