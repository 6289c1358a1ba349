! RAPID Overview, persistents: what one task writes, another divides by.
MODULE first
  PERS num parts:=1;

  PROC main()
    TPWrite "begins";                   ! -> begins
    WaitTime 1;
    parts:=0;
    WaitTime 1;
  ENDPROC
ENDMODULE
