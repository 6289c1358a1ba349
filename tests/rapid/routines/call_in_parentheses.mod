! RAPID Kernel, Procedure calls: only functions take their arguments in parentheses.
MODULE call_in_parentheses
  PROC main()
    both(1,2);                        ! error: E141
    plain();                          ! error: E141
    option(\fast);                    ! error: E141
    both(a:=1,b:=2);                  ! error: E141
    option(\fast,\slow);              ! error: E141
    both(1,b:=2);                     ! error: E141
    MoveJ(*,v100,fine,tool0);         ! error: E141 ! warning: E148
    both 1,2;
  ENDPROC

  PROC both(num a,num b)
  ENDPROC

  PROC plain()
  ENDPROC

  PROC option(\switch fast\switch slow)
  ENDPROC
ENDMODULE
