! Field practice, Compact IF: used for anything, even calls with many arguments.
MODULE compact_if_at_length
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR bool bHome:=TRUE;

  PROC main()
    IF bHome MoveAbsJ jHome\NoEOffs,v1000,fine,tool0\WObj:=wobj0;
    IF(bHome) TPWrite "home";             ! -> home
    IF (bHome) AND TRUE TPWrite "still";  ! -> still
    IF bHome=TRUE THEN TPWrite "yes"; ENDIF  ! -> yes
  ENDPROC
ENDMODULE
