! RAPID Kernel, Variable declarations: an initial value is known before the program runs.
MODULE initial_values
  CONST num BASE:=10;
  VAR num from_constants:=BASE*2+1;
  VAR num other;
  VAR num from_variable:=other;   ! error: T311
  VAR speeddata slow:=v100;
  VAR robtarget here:=CRobT();    ! error: T311

  PROC main()
    VAR num start:=other;         ! error: T311
    other:=start;
  ENDPROC
ENDMODULE
