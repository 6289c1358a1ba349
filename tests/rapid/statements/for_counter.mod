! RAPID Kernel, FOR: start, end and step are evaluated once; the counter is the loop's own.
MODULE for_counter
  VAR num i:=100;
  VAR num end_of_loop:=2;

  PROC main()
    FOR i FROM 1 TO end_of_loop DO
      end_of_loop:=10;
      TPWrite "turn "\Num:=i;
      ! -> turn 1
      ! -> turn 2
    ENDFOR
    TPWrite "outside "\Num:=i;        ! -> outside 100
  ENDPROC
ENDMODULE
