! Field practice, Targets: unused axes as 9E9, 9E+9, 9E+09, 9000000000 or 9999.
MODULE ninety_nine
  CONST extjoint a:=[9E9,9E+9,9E+09,9e9,9E09,9000000000];
  CONST extjoint b:=[9E9,9E9,9E9,9E9,9E9,9E9];
  CONST robtarget pOld:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9999,9999,9999,9999,9999,9999]];

  PROC main()
    TPWrite ValToStr(a=b);                ! -> TRUE
    MoveJ pOld,v500,fine,tool0;
    TPWrite "arrived";                    ! -> arrived
  ENDPROC
ENDMODULE
