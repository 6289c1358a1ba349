! RAPID Kernel, Constant declarations: constants may be made of constants, in any order.
MODULE constants
  CONST num twice:=2*once;
  CONST num once:=-21;
  CONST pos corner:=[once,twice,0];
  CONST num list{2}:=[once,twice];
  CONST string greeting:="good "+"day";

  PROC main()
    CONST num inner:=twice/2;
    TPWrite ValToStr(twice);        ! -> -42
    TPWrite ValToStr(corner);       ! -> [-21,-42,0]
    TPWrite ValToStr(list{2});      ! -> -42
    TPWrite greeting;               ! -> good day
    TPWrite ValToStr(inner);        ! -> -21
  ENDPROC
ENDMODULE
