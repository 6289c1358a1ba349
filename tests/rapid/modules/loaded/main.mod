! RAPID Instructions, Load, UnLoad: a module comes with its initial values, and goes with what it held.
MODULE main_module
  PERS num total:=1;
  VAR num made;

  PROC main()
    FOR i FROM 1 TO 2 DO
      Load
        \Dynamic,"HOME:" \File:="part.mod" \CheckRef;
      %"part:main"%;
      %"make"% 5;
      UnLoad "HOME:" \File:="part.mod";
    ENDFOR
    TPWrite ValToStr(ModExist("part"));   ! -> FALSE
    %"make"% 5;
  ERROR
    IF ERRNO=ERR_REFUNKPRC THEN
      TPWrite "gone";                     ! -> gone
    ENDIF
    TRYNEXT;
  ENDPROC

  PROC told(string what,num n)
    TPWrite what\Num:=n;
    ! -> main of the part 1
    ! -> calls in the part 1
    ! -> made here 5
    ! -> main of the part 6
    ! -> calls in the part 1
    ! -> made here 10
  ENDPROC
ENDMODULE
