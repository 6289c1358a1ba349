! RAPID Kernel, FOR: the counter is read only, and gone after the loop.
MODULE for_counter_wrong
  PROC main()
    FOR k FROM 1 TO 3 DO
      k:=3;                         ! error: T304
      Incr k;                       ! error: T303
    ENDFOR
    TPWrite ValToStr(k);            ! error: N201
    FOR k FROM TRUE TO 3 DO         ! error: T301
    ENDFOR
  ENDPROC
ENDMODULE
