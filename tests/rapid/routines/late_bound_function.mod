! RAPID Kernel, Late binding: procedures only.
MODULE late_bound_function
  VAR num n;

  PROC main()
    n:=%"half"%(2);                       ! error: E145
    n:=%"half"%();                        ! error: E145
    %n%;                                  ! error: T301
  ENDPROC
ENDMODULE
