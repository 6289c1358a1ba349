! Field practice, Argument lists: options directly behind the name or the first argument.
MODULE options_before_arguments
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR string text:="n";

  PROC main()
    MoveAbsJ jHome\NoEOffs,v1000,fine,tool0;
    MoveAbsJ jHome , \NoEOffs, v1000, fine, tool0, \WObj:=wobj0;
    WaitTime\InPos,0.1;
    WaitTime \InPos, 0.1;
    TPWrite text\Num:=1;                  ! -> n1
    TPWrite text,\Num:=2;                 ! -> n2
    TPWrite text \Num := 3 ;              ! -> n3
  ENDPROC
ENDMODULE
