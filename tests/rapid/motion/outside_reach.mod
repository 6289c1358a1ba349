! RAPID Functions, CalcJointT: a target out of reach is an error that a program can handle.
MODULE outside_reach
  CONST robtarget far:=[[3000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR errnum number;
  VAR jointtarget joints;

  PROC main()
    joints:=CalcJointT(far,tool0\ErrorNumber:=number);
    TPWrite "told: "\Bool:=number=ERR_OUTSIDE_REACH;     ! -> told: TRUE
    MoveJ far,v500,fine,tool0;                          ! warning: K601
    TPWrite "and goes on";                               ! -> and goes on
  ERROR
    IF ERRNO=ERR_OUTSIDE_REACH THEN
      TPWrite "caught";                                  ! -> caught
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
