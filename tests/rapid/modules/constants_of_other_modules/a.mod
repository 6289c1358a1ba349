! RAPID Kernel, Constant expressions: constants of other modules, in any order of the files.
MODULE a
  CONST num total:=count*size;
  VAR num list{count}:=[1,2,3];

  PROC main()
    TPWrite ValToStr(total);              ! -> 30
    TPWrite ValToStr(list{count});        ! -> 3
    TPWrite "a";                          ! -> a
    a_routine;
  ENDPROC
ENDMODULE
