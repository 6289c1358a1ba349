MODULE example
  RECORD pallet
    num heights{4}; ! found
  ENDRECORD
ENDMODULE
