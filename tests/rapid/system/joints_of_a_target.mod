! RAPID Functions, CalcJointT: what cannot be reached is an error, or a number.
MODULE joints_of_a_target
  VAR errnum why;

  PROC main()
    VAR jointtarget j;
    VAR robtarget p;
    p:=CalcRobT([[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    j:=CalcJointT(p,tool0);
    TPWrite ValToStr(Round(j.robax.rax_5)); ! -> 30
    j:=CalcJointT(Offs(p,5000,0,0),tool0);
    j:=CalcJointT(Offs(p,5000,0,0),tool0\ErrorNumber:=why);
    TPWrite ValToStr(why=ERR_ROBLIMIT OR why=ERR_OUTSIDE_REACH); ! -> TRUE
    p:=CalcRobT([[0,0,0,0,30,1000],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    j:=CalcJointT(p,tool0);
    TPWrite "end";                          ! -> end
  ERROR
    IF ERRNO=ERR_ROBLIMIT TPWrite "limit"; ! -> limit
    IF ERRNO=ERR_OUTSIDE_REACH TPWrite "reach"; ! -> reach
    TRYNEXT;
  ENDPROC
ENDMODULE
