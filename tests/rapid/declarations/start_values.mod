! RAPID Kernel, Variable declarations: without an initial value everything is zero.
MODULE start_values
  VAR num n;
  VAR dnum d;
  VAR bool b;
  VAR string s;
  VAR pos p;
  VAR robtarget target;
  VAR num list{3};

  PROC main()
    TPWrite ValToStr(n);          ! -> 0
    TPWrite ValToStr(d);          ! -> 0
    TPWrite ValToStr(b);          ! -> FALSE
    TPWrite "["+s+"]";            ! -> []
    TPWrite ValToStr(p);          ! -> [0,0,0]
    TPWrite ValToStr(list);       ! -> [0,0,0]
    TPWrite ValToStr(target.rot); ! -> [0,0,0,0]
  ENDPROC
ENDMODULE
