! RAPID Kernel, Functions: they too may change what they are given by reference.
MODULE functions_change_arguments
  VAR num stack{3};
  VAR num height;

  PROC main()
    IF push(5) AND push(6) AND push(7) AND NOT push(8) TPWrite "full";  ! -> full
    TPWrite ValToStr(taken(height));      ! -> 7
    TPWrite ValToStr(height);             ! -> 2
  ENDPROC

  FUNC bool push(num value)
    IF height=Dim(stack,1) RETURN FALSE;
    height:=height+1;
    stack{height}:=value;
    RETURN TRUE;
  ENDFUNC

  FUNC num taken(INOUT num count)
    count:=count-1;
    RETURN stack{count+1};
  ENDFUNC
ENDMODULE
