! RAPID Kernel, Data declarations: a value is given with := everywhere.
MODULE equals_sign
  VAR num n=3;                    ! error: E140
  LOCAL CONST num m=3;            ! error: E140
  PERS num list{2}=[1,2];         ! error: E140
  TASK VAR num rows{2}=[1,2];     ! error: E140
  CONST limit = 3;                ! error: N210 ! error: E113

  PROC main()
    n=4;                          ! error: E140
  ENDPROC
ENDMODULE
