! RAPID Functions, CalcJointT: a target out of reach is an error that a program can handle; a move
! there stops the program, whatever clauses there are.
MODULE outside_reach
  CONST robtarget far:=[[3000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR errnum number;
  VAR jointtarget joints;

  PROC main()
    joints:=CalcJointT(far,tool0\ErrorNumber:=number);
    TPWrite "told: "\Bool:=number=ERR_OUTSIDE_REACH;     ! -> told: TRUE
    joints:=CalcJointT(far,tool0);
    TPWrite "and goes on";                               ! -> and goes on
    MoveJ far,v500,fine,tool0;
      ! stops: `far` cannot be reached by ABB IRB 1600-6/1.2: wrist centre 1776.1 mm beyond reach: the stretched arm puts it 1075.0 mm from axis 2, the target asks for 2851.1 mm
  ERROR
    IF ERRNO=ERR_OUTSIDE_REACH THEN
      TPWrite "caught";                                  ! -> caught
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
