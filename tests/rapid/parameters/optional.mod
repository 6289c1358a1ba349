! RAPID Kernel, Optional parameters: given with a backslash; Present tells whether.
MODULE optional_parameters
  VAR num n:=5;

  PROC main()
    show 1;
    show 1\height:=2;
    show 1,\height:=2\fast;
    show 1\fast;
    show\ahead,1;
    grow n;
    grow n\by:=10;
    TPWrite ValToStr(n);                  ! -> 16
  ENDPROC

  PROC show(\switch ahead,num a\num height\switch fast)
    VAR string text;
    text:="a="+ValToStr(a);
    IF Present(ahead) text:="ahead "+text;
    IF Present(height) text:=text+" height="+ValToStr(height);
    IF Present(fast) text:=text+" fast";
    TPWrite text;
    ! -> a=1
    ! -> a=1 height=2
    ! -> a=1 height=2 fast
    ! -> a=1 fast
    ! -> ahead a=1
  ENDPROC

  PROC grow(INOUT num x\num by)
    IF Present(by) THEN
      x:=x+by;
    ELSE
      x:=x+1;
    ENDIF
  ENDPROC
ENDMODULE
