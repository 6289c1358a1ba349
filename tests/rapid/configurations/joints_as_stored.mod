! RAPID Functions, CalcJointT: a stored configuration that the arm cannot take is an error.
MODULE joints_as_stored
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget wound;
    wound:=p1;
    wound.robconf.cf6:=9;
    joints wound;
    joints p1;
    ConfJ\Off;
    joints wound;
  ENDPROC

  PROC joints(robtarget there)
    VAR errnum why;
    VAR jointtarget j;
    j:=CalcJointT(there,tool0\ErrorNumber:=why);
    TPWrite ValToStr(why=ERR_ROBLIMIT);
    ! -> TRUE
    ! -> FALSE
    ! -> FALSE
    j:=CalcJointT(there,tool0);
    TPWrite "axis 5 "\Num:=Round(j.robax.rax_5);
    ! -> axis 5 60
    ! -> axis 5 60
  ERROR
    TPWrite "caught "\Bool:=ERRNO=ERR_ROBLIMIT; ! -> caught TRUE
    RETURN;
  ENDPROC
ENDMODULE
