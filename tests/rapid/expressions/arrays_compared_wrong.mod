! RAPID Kernel, expressions: arrays of other types or sizes do not compare, and none has an order.
MODULE arrays_compared_wrong
  VAR num a{3};
  VAR num b{4};
  VAR dnum c{3};

  PROC main()
    TPWrite ValToStr(a=b);                  ! error: T313
    TPWrite ValToStr(a=c);                  ! error: T313
    TPWrite ValToStr(a<a);                  ! error: T313
  ENDPROC
ENDMODULE
