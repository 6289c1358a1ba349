! RAPID Kernel, FOR: from start to end, both included; down by itself where the end is below.
MODULE for_loops
  VAR string seen;
  VAR num last:=3;

  PROC main()
    FOR i FROM 1 TO last DO
      add i;
    ENDFOR
    show;                         ! 1 2 3
    FOR i FROM last TO 1 DO
      add i;
    ENDFOR
    show;                         ! 3 2 1
    FOR i FROM 1 TO 7 STEP last DO
      add i;
    ENDFOR
    show;                         ! 1 4 7
    FOR i FROM 10 TO 1 STEP -4 DO
      add i;
    ENDFOR
    show;                         ! 10 6 2
    FOR i FROM 0 TO 1 STEP 0.5 DO
      add i;
    ENDFOR
    show;                         ! 0 0.5 1
    FOR i FROM 2 TO 1 STEP 1 DO
      add i;
    ENDFOR
    show;                         ! nothing
  ENDPROC

  PROC add(num n)
    seen:=seen+" "+ValToStr(n);
  ENDPROC

  PROC show()
    TPWrite "counted"+seen;
    ! -> counted 1 2 3
    ! -> counted 3 2 1
    ! -> counted 1 4 7
    ! -> counted 10 6 2
    ! -> counted 0 0.5 1
    ! -> counted
    seen:="";
  ENDPROC
ENDMODULE
