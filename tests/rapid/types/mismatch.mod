! RAPID Kernel, Type equality: a value has the type of its place.
MODULE mismatch
  VAR num n;
  VAR bool b;
  VAR string s;

  PROC main()
    n:=TRUE;                        ! error: T301
    b:=1;                           ! error: T301
    s:=n;                           ! error: T301
    IF n THEN                       ! error: T301
      n:=1;
    ENDIF
    s:="n is "+n;                   ! error: T313
    TPWrite n;                      ! error: T301
  ENDPROC
ENDMODULE
