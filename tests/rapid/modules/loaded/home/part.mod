MODULE part
  VAR num calls;

  LOCAL PROC main()
    told "main of the part ",total;
  ENDPROC

  PROC make(num count)
    Incr calls;
    told "calls in the part ",calls;
    made:=made+count;
    total:=total+count;
    told "made here ",made;
  ENDPROC
ENDMODULE
