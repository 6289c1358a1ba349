! RAPID Kernel, Aggregates: their place gives them a type; they may hold expressions.
MODULE aggregates
  VAR num n:=2;
  VAR pose frame;
  VAR num list{1};

  PROC main()
    frame:=[[n,n*2,n*3],[1,0,0,0]];
    list:=[n];
    TPWrite ValToStr(list);                     ! -> [2]
    TPWrite ValToStr(frame.trans);              ! -> [2,4,6]
    TPWrite ValToStr(frame.trans=[2,4,6]);      ! -> TRUE
    TPWrite ValToStr(Distance([0,0,0],[3,4,0])); ! -> 5
    TPWrite ValToStr(VectMagn([n+1,4,0]));      ! -> 5
  ENDPROC
ENDMODULE
