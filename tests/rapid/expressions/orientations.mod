! RAPID Kernel, Operators of orient: * turns further.
MODULE orientations
  CONST orient half_turn:=[0,0,0,1];

  PROC main()
    TPWrite ValToStr(half_turn*half_turn);    ! -> [-1,0,0,0]
    TPWrite ValToStr(half_turn=[0,0,0,1]);    ! -> TRUE
  ENDPROC
ENDMODULE
