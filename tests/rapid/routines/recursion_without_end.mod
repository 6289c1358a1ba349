! RAPID Kernel, Routines: calls nest as deep as memory lasts.
MODULE recursion_without_end
  PROC main()
    deeper 1;
  ENDPROC

  PROC deeper(num n)
    deeper n+1;                           ! stops: the stack overflowed in deeper: routines call each other about 10000 deep
  ENDPROC
ENDMODULE
