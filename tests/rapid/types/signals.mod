! RAPID Kernel, Semi-value types: an input signal reads as its value.
MODULE signals
  VAR signaldi diPart;
  VAR signaldo doLamp;
  VAR num seen;
  VAR signaldi diWrong:=1;        ! error: T318

  PROC main()
    seen:=diPart;
    IF diPart=1 AND doLamp=0 seen:=2;
  ENDPROC
ENDMODULE
