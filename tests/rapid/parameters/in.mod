! RAPID Kernel, Parameters: without a mode the routine has a copy of its own.
MODULE in_mode
  VAR num n:=1;
  VAR pos p:=[1,2,3];

  PROC main()
    change n,p;
    change 2*n,[4,5,6];
    TPWrite ValToStr(n)+ValToStr(p);      ! -> 1[1,2,3]
  ENDPROC

  PROC change(num x,pos at)
    x:=x+10;
    at.x:=0;
    TPWrite ValToStr(x)+ValToStr(at);
    ! -> 11[0,2,3]
    ! -> 12[0,5,6]
  ENDPROC
ENDMODULE
