! RAPID Kernel, Parameters: what may be changed is needed where the routine changes it.
MODULE modes_wrong
  CONST num fixed:=1;
  VAR num n;
  PERS num kept:=1;
  PERS num list{2}:=[1,2];

  PROC main()
    change fixed;                         ! error: T303
    change n+1;                           ! error: T303
    change 5;                             ! error: T303
    need_var kept;                        ! error: T303
    need_pers n;                          ! error: T303
    need_pers list{1};                    ! warning: T323
    change n;
    change kept;
    need_var n;
    need_pers kept;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,
      [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];   ! error: T303
  ENDPROC

  PROC change(INOUT num x)
  ENDPROC

  PROC need_var(VAR num x)
  ENDPROC

  PROC need_pers(PERS num x)
  ENDPROC
ENDMODULE
