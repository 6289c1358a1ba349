! RAPID Kernel, Routine data: they exist as long as the call, so only those of active calls fill the memory.
MODULE arrays_of_ended_calls
  VAR num filled;

  PROC main()
    ! Each call of fill has 44 MB, all together would have more than a program may.
    visit 20;
    TPWrite ValToStr(filled);             ! -> 21
  ENDPROC

  PROC visit(num left)
    fill;
    IF left>0 visit left-1;
  ENDPROC

  PROC fill()
    VAR robtarget places{100000};
    places{100000}.trans.x:=1;
    filled:=filled+places{100000}.trans.x;
  ENDPROC
ENDMODULE
