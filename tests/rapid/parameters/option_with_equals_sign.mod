! RAPID Kernel, Argument lists: an optional argument gets its value with :=, as everything does.
MODULE option_with_equals_sign
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ jHome,v100,z10,tool0,\WObj=wobj0;      ! error: E114
    MoveAbsJ jHome,v100\T=2,z10,tool0\WObj:=wobj0;  ! error: E114
    TPWrite "rounded "\Num:=Round(2.5\Dec=1);       ! error: E114
  ENDPROC
ENDMODULE
