! RAPID Kernel, Scope rules: also across files, and modules have names too.
MODULE b
  PROC main()                           ! error: N202
  ENDPROC
  VAR num COUNT;                        ! error: N202
  LOCAL VAR num mine;
ENDMODULE

MODULE A                                ! error: N202
ENDMODULE
