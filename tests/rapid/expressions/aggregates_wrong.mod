! RAPID Kernel, Aggregates: without a place that has a type they mean nothing.
MODULE aggregates_wrong
  VAR pose frame;

  PROC main()
    frame:=[];                          ! error: T305
    frame:=[[1,2,3]];                   ! error: T305
    frame:=[1,2];                       ! error: T301, T301
    TPWrite ValToStr([1,2,3]);          ! error: T316
  ENDPROC
ENDMODULE
