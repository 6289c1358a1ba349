! RAPID Kernel, Argument lists: all required arguments, no others, in the order declared.
MODULE counts_wrong
  CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;

  PROC main()
    both 1;                               ! error: T302
    both 1,2,3;                           ! error: T302
    both 1\extra:=3,2;                    ! error: T302
    both b:=1,a:=2;                       ! error: T302, T302
    MoveL p1,v100;                        ! error: T302
    MoveL p1,v100,tool0;                  ! error: T302
    n:=Abs();                             ! error: T302
    n:=Abs(1,2);                          ! error: T302
    both 1,2\extra:=3;
  ENDPROC

  PROC both(num a,num b\num extra)
  ENDPROC
ENDMODULE
