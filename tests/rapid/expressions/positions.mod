! RAPID Kernel, Operators of pos: sum, difference, scaling from both sides, vector product.
MODULE positions
  VAR pos a:=[1,2,3];
  VAR pos b:=[4,5,6];

  PROC main()
    TPWrite ValToStr(a+b);                ! -> [5,7,9]
    TPWrite ValToStr(b-a);                ! -> [3,3,3]
    TPWrite ValToStr(-a);                 ! -> [-1,-2,-3]
    TPWrite ValToStr(+a);                 ! -> [1,2,3]
    TPWrite ValToStr(2*a);                ! -> [2,4,6]
    TPWrite ValToStr(a*2);                ! -> [2,4,6]
    TPWrite ValToStr(a*b);                ! -> [-3,6,-3]
    TPWrite ValToStr(a+b=[5,7,9]);        ! -> TRUE
  ENDPROC
ENDMODULE
