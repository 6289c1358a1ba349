! RAPID Kernel, Record types: a record has at least one component.
MODULE records_of_nothing
  RECORD nothing                        ! error: E150
  ENDRECORD
ENDMODULE
