MODULE Questions
  ! Twenty small questions to a controller, real or virtual. Main asks them all, in two minutes, and
  ! writes the answers to HOME:/rapidsim_answers.txt. `rapidsim protocol FILE` reads that file.
  !
  ! If a question stops the program, that is an answer: write down the number of the event, set the
  ! program pointer to main and start again. Main goes on with the next question.
  !
  ! Questions 18 to 20 move the arm, with tool0 and without a load: first to [0,0,0,0,30,0], from
  ! wherever it is, then at full speed 150 mm to either side, and axis 1 from 0 to 60 degrees.
  ! FALSE here leaves them out.
  LOCAL CONST bool with_moves:=TRUE;

  ! The routines stop_1 to stop_5 each stop the program: start them by hand (PP to Routine) and write
  ! down the number of the event, and what they write to the operator.

  LOCAL PERS num asked:=0;
  LOCAL VAR iodev answers;
  LOCAL VAR iodev other;
  LOCAL VAR num tries;
  LOCAL VAR num zero:=0;
  LOCAL VAR clock watch;
  LOCAL CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR num last:=17;
    IF with_moves last:=20;
    IF asked=0 begin_answers;
    WHILE asked<last DO
      asked:=asked+1;
      answer asked,"the program stops";
      ask asked;
    ENDWHILE
    asked:=0;
    TPWrite "Done: HOME:/rapidsim_answers.txt";
  ENDPROC

  PROC begin_answers()
    Open "HOME:/rapidsim_answers.txt",answers\Write;
    Write answers,"questions;2";
    Write answers,"robotware;"+GetSysInfo(\SWVersion);
    Write answers,"robot;"+GetSysInfo(\RobotType);
    Write answers,"real;"+ValToStr(RobOS());
    Write answers,"automatic;"+ValToStr(OpMode()=OP_AUTO);
    Write answers,"speed;"+ValToStr(CSpeedOverride());
    Close answers;
  ENDPROC

  ! The last answer to a question counts.
  PROC answer(num question,string text)
    Open "HOME:/rapidsim_answers.txt",answers\Append;
    Write answers,ValToStr(question)+";"+text;
    Close answers;
  ENDPROC

  FUNC string error_name(errnum code)
    TEST code
    CASE ERR_DIVZERO:
      RETURN "ERR_DIVZERO";
    CASE ERR_STRTOOLNG:
      RETURN "ERR_STRTOOLNG";
    CASE ERR_ILLDIM:
      RETURN "ERR_ILLDIM";
    CASE ERR_ROBLIMIT:
      RETURN "ERR_ROBLIMIT";
    CASE ERR_EXCRTYMAX:
      RETURN "ERR_EXCRTYMAX";
    CASE ERR_ARGVALERR:
      RETURN "ERR_ARGVALERR";
    CASE ERR_FILEOPEN:
      RETURN "ERR_FILEOPEN";
    CASE ERR_FILEACC:
      RETURN "ERR_FILEACC";
    ENDTEST
    RETURN "ERRNO "+ValToStr(code);
  ENDFUNC

  PROC ask(num question)
    TEST question
    CASE 1:
      quotient;
    CASE 2:
      remainder;
    CASE 3:
      binary_file;
    CASE 4:
      retries;
    CASE 5:
      error_number_after_clause;
    CASE 6:
      large_number;
    CASE 7:
      answer 7,ValToStr(0.1+0.2);
    CASE 8:
      answer 8,ValToStr(Round(2.5))+" "+ValToStr(Round(-2.5))+" "+ValToStr(Round(3.5));
    CASE 9:
      long_text;
    CASE 10:
      odd_index;
    CASE 11:
      missing_dimension;
    CASE 12:
      no_number;
    CASE 13:
      configuration 13,1,0;
    CASE 14:
      configuration 14,2,0;
    CASE 15:
      configuration 15,0,1;
    CASE 16:
      loops;
    CASE 17:
      no_wait;
    CASE 18:
      tiny_moves;
    CASE 19:
      picking;
    CASE 20:
      swing;
    ENDTEST
  ENDPROC

  PROC quotient()
    VAR num n:=7.5;
    n:=n DIV 2;
    answer 1,ValToStr(n);
  ERROR
    answer 1,error_name(ERRNO);
    RETURN;
  ENDPROC

  PROC remainder()
    VAR num n:=7.5;
    n:=n MOD 2;
    answer 2,ValToStr(n);
  ERROR
    answer 2,error_name(ERRNO);
    RETURN;
  ENDPROC

  ! Is a file that is opened with \Bin alone begun anew, or appended to?
  PROC binary_file()
    VAR num bytes{2}:=[65,66];
    Open "HOME:/rapidsim_bytes.bin",other\Write\Bin;
    WriteBin other,bytes,2;
    Close other;
    Open "HOME:/rapidsim_bytes.bin",other\Bin;
    WriteBin other,bytes,2;
    Close other;
    answer 3,ValToStr(FileSize("HOME:/rapidsim_bytes.bin"));
    RemoveFile "HOME:/rapidsim_bytes.bin";
  ERROR
    answer 3,error_name(ERRNO);
    RETURN;
  ENDPROC

  ! How often may RETRY answer an error before the next clause is asked?
  PROC retries()
    tries:=0;
    fails_always;
    answer 4,"no error";
  ERROR
    answer 4,ValToStr(tries);
    RETURN;
  ENDPROC

  PROC fails_always()
    zero:=0;
    zero:=1/zero;
  ERROR
    tries:=tries+1;
    IF tries>50 RETURN;
    RETRY;
  ENDPROC

  ! What is ERRNO in a clause after it has called a routine with a clause of its own?
  PROC error_number_after_clause()
    VAR errnum before;
    VAR errnum after;
    zero:=0;
    zero:=1/zero;
  ERROR
    before:=ERRNO;
    odd_text;
    after:=ERRNO;
    answer 5,error_name(before)+", then "+error_name(after);
    RETURN;
  ENDPROC

  PROC odd_text()
    VAR string text;
    text:=StrPart("abc",9,1);
  ERROR
    RETURN;
  ENDPROC

  PROC large_number()
    VAR num n:=16777216;
    n:=n+1;
    answer 6,ValToStr(n=16777216)+" "+ValToStr(n);
  ENDPROC

  PROC long_text()
    VAR string text:="0123456789012345678901234567890123456789";
    text:=text+text+"x";
    answer 9,ValToStr(StrLen(text));
  ERROR
    answer 9,error_name(ERRNO);
    RETURN;
  ENDPROC

  PROC odd_index()
    VAR num list{3}:=[1,2,3];
    VAR num index:=1.5;
    answer 10,"element "+ValToStr(list{index});
  ERROR
    answer 10,error_name(ERRNO);
    RETURN;
  ENDPROC

  PROC missing_dimension()
    VAR num list{3,2};
    VAR num dimension:=3;
    answer 11,ValToStr(Dim(list,dimension));
  ERROR
    answer 11,error_name(ERRNO);
    RETURN;
  ENDPROC

  PROC no_number()
    VAR num n:=5;
    VAR bool ok;
    ok:=StrToVal("twelve",n);
    answer 12,ValToStr(ok)+" "+ValToStr(n);
  ERROR
    answer 12,error_name(ERRNO);
    RETURN;
  ENDPROC

  ! Is a target reached whose stored configuration is off by quarters of axis 1, or by a branch?
  ! All axes tell by which configuration.
  PROC configuration(num question,num quarters,num branch)
    VAR robtarget target;
    VAR robjoint axes;
    target:=CalcRobT(home,tool0);
    target.robconf.cf1:=target.robconf.cf1+quarters;
    target.robconf.cfx:=target.robconf.cfx+branch;
    axes:=robax_of(CalcJointT(target,tool0));
    answer question,whole(axes.rax_1)+" "+whole(axes.rax_2)+" "+whole(axes.rax_3)+" "
      +whole(axes.rax_4)+" "+whole(axes.rax_5)+" "+whole(axes.rax_6);
  ERROR
    answer question,error_name(ERRNO);
    RETURN;
  ENDPROC

  FUNC robjoint robax_of(jointtarget joints)
    RETURN joints.robax;
  ENDFUNC

  FUNC string whole(num angle)
    ! Abs, for zero may have a sign.
    IF Abs(angle)<0.5 RETURN "0";
    RETURN NumToStr(angle,0);
  ENDFUNC

  PROC loops()
    VAR num count:=0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 10000 DO
      count:=count+1;
    ENDFOR
    ClkStop watch;
    answer 16,NumToStr(ClkRead(watch),3);
  ENDPROC

  PROC no_wait()
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 100 DO
      WaitTime 0;
    ENDFOR
    ClkStop watch;
    answer 17,NumToStr(ClkRead(watch),3);
  ENDPROC

  ! What does a stop point cost behind a move of a tenth of a millimetre?
  PROC tiny_moves()
    VAR robtarget start;
    MoveAbsJ home,v200,fine,tool0;
    start:=CRobT(\Tool:=tool0\WObj:=wobj0);
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 20 DO
      MoveL Offs(start,0,0,0.1*i),v200,fine,tool0;
    ENDFOR
    ClkStop watch;
    answer 18,NumToStr(ClkRead(watch),3);
  ENDPROC

  PROC picking()
    VAR robtarget start;
    MoveAbsJ home,v200,fine,tool0;
    start:=CRobT(\Tool:=tool0\WObj:=wobj0);
    start:=Offs(start,0,-150,0);
    MoveL start,v200,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 3 DO
      MoveL Offs(start,0,0,25),vmax,z10,tool0;
      MoveL Offs(start,0,300,25),vmax,z10,tool0;
      MoveL Offs(start,0,300,0),vmax,fine,tool0;
      MoveL Offs(start,0,300,25),vmax,z10,tool0;
      MoveL Offs(start,0,0,25),vmax,z10,tool0;
      MoveL start,vmax,fine,tool0;
    ENDFOR
    ClkStop watch;
    MoveAbsJ home,v200,fine,tool0;
    answer 19,NumToStr(ClkRead(watch),3);
  ENDPROC

  PROC swing()
    VAR jointtarget there;
    there:=home;
    there.robax.rax_1:=60;
    MoveAbsJ home,v200,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 3 DO
      MoveAbsJ there,vmax,fine,tool0;
      MoveAbsJ home,vmax,fine,tool0;
    ENDFOR
    ClkStop watch;
    answer 20,NumToStr(ClkRead(watch),3);
  ENDPROC

  ! Each of these stops the program. Which event does the log show, and what does the operator see?

  PROC stop_1()
    MoveAbsJ home,v200,fine,tool0;
    MoveL Offs(CRobT(\Tool:=tool0\WObj:=wobj0),9000,0,0),v200,fine,tool0;
    TPWrite "stop_1: no error";
    Stop;
  ERROR
    TPWrite "stop_1: the clause runs";
    Stop;
  ENDPROC

  PROC stop_2()
    VAR robtarget target;
    MoveAbsJ home,v200,fine,tool0;
    target:=CRobT(\Tool:=tool0\WObj:=wobj0);
    target.robconf.cf1:=target.robconf.cf1+2;
    MoveJ target,v200,fine,tool0;
    TPWrite "stop_2: no error";
    Stop;
  ERROR
    TPWrite "stop_2: the clause runs";
    Stop;
  ENDPROC

  PROC stop_3()
    VAR robtarget target;
    MoveAbsJ home,v200,fine,tool0;
    target:=CRobT(\Tool:=tool0\WObj:=wobj0);
    target.rot:=[0,0,0,0];
    MoveJ target,v200,fine,tool0;
    TPWrite "stop_3: no error";
    Stop;
  ERROR
    TPWrite "stop_3: the clause runs";
    Stop;
  ENDPROC

  PROC stop_4()
    zero:=0;
    zero:=1/zero;
    TPWrite "stop_4: no error";
    Stop;
  ENDPROC

  PROC stop_5()
    %"no_such_routine"%;
    TPWrite "stop_5: no error";
    Stop;
  ENDPROC
ENDMODULE
